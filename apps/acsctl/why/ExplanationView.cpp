#include "why/ExplanationView.hpp"

#include "view/DetailList.hpp"
#include "view/DisplayText.hpp"
#include "view/EStyle.hpp"
#include <acs/json/JsonWriter.hpp>

#include <array>
#include <cstdint>
#include <string_view>

namespace ACS::Acsctl
{

namespace
{

constexpr std::size_t INDENT = 2;
constexpr std::array<std::string_view, 3> SUBJECTS{"acsd", "plan", "robot"};

void WriteText(Json::JsonWriter& writer, std::string_view key, std::string_view text)
{
    writer.Key(key);
    writer.WriteString(text);
}

void WriteCause(Json::JsonWriter& writer, const Cause& cause)
{
    writer.BeginObject();
    writer.Key("depth");
    writer.WriteUnsigned(cause.depth);
    WriteText(writer, "text", cause.text);
    writer.Key("cause");
    if (cause.origin.empty())
    {
        writer.WriteNull();
    }
    else
    {
        writer.WriteString(cause.origin);
    }
    writer.Key("remedy");
    writer.BeginArray();
    for (const std::string& line : cause.remedy)
    {
        writer.WriteString(line);
    }
    writer.EndArray();
    writer.EndObject();
}

} // namespace

std::string PrintExplanation(const Explanation& explanation, const Screen& screen)
{
    std::string out;
    for (const Finding& finding : explanation.findings)
    {
        out += out.empty() ? "" : "\n";
        const EStyle style = finding.bAttention ? EStyle::Bad : EStyle::Good;
        for (const std::string& line : WrapText(MakeDisplayable(finding.text), screen.columns))
        {
            out += Paint(line, style, screen.bColored);
            out += '\n';
        }
        for (const Cause& cause : finding.causes)
        {
            const std::size_t indent = INDENT * (cause.depth + 1);
            AppendIndented(out, cause.text, indent, screen);
            if (!cause.origin.empty())
            {
                AppendIndented(out, "Cause: " + cause.origin, indent + INDENT, screen);
            }
            for (const std::string& line : cause.remedy)
            {
                AppendIndented(out, "Remedy: " + line, indent + INDENT, screen);
            }
        }
    }
    return out;
}

std::string MakeExplanationText(const Explanation& explanation)
{
    std::string out;
    Json::JsonWriter writer(out);
    writer.BeginObject();
    writer.Key("needsAttention");
    writer.WriteBoolean(explanation.NeedsAttention());
    writer.Key("findings");
    writer.BeginArray();
    for (const Finding& finding : explanation.findings)
    {
        writer.BeginObject();
        WriteText(writer, "subject", SUBJECTS.at(static_cast<std::size_t>(finding.subject)));
        writer.Key("id");
        if (finding.id.empty())
        {
            writer.WriteNull();
        }
        else
        {
            writer.WriteString(finding.id);
        }
        WriteText(writer, "text", finding.text);
        writer.Key("needsAttention");
        writer.WriteBoolean(finding.bAttention);
        writer.Key("causes");
        writer.BeginArray();
        for (const Cause& cause : finding.causes)
        {
            WriteCause(writer, cause);
        }
        writer.EndArray();
        writer.EndObject();
    }
    writer.EndArray();
    writer.EndObject();
    return MakeDisplayableJSON(out);
}

} // namespace ACS::Acsctl
