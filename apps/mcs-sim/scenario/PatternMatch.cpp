#include "scenario/PatternMatch.hpp"

#include <acs/json/JsonDocument.hpp>
#include <acs/json/JsonWriter.hpp>

#include <fmt/format.h>

#include <utility>

namespace ACS::McsSim
{

namespace
{

using Json::Value;

std::string_view GetTextView(const Value& text)
{
    return {text.GetString(), text.GetStringLength()};
}

std::string MakePath(std::string_view path, std::string_view name)
{
    return path.empty() ? std::string(name) : fmt::format("{}.{}", path, name);
}

void WriteFilledRecursive( // NOLINT(misc-no-recursion): as deep as the parser's limit
    const Value& value,
    const PlaceholderReader& read,
    Json::JsonWriter& writer)
{
    if (value.IsString())
    {
        writer.WriteString(FillPlaceholders(GetTextView(value), read));
    }
    else if (value.IsObject())
    {
        writer.BeginObject();
        for (const auto& member : value.GetObject())
        {
            writer.Key(GetTextView(member.name));
            WriteFilledRecursive(member.value, read, writer);
        }
        writer.EndObject();
    }
    else if (value.IsArray())
    {
        writer.BeginArray();
        for (const Value& element : value.GetArray())
        {
            WriteFilledRecursive(element, read, writer);
        }
        writer.EndArray();
    }
    else
    {
        writer.WriteRaw(Core::JsonText::FromTrusted(Json::WriteText(value)));
    }
}

/// Compares message and pattern; what fills in the placeholders comes along.
class Matcher
{
    const PlaceholderReader& _read;

public:
    explicit Matcher(const PlaceholderReader& read)
        : _read(read)
    {
    }

    /// A value that is absent is a null one. As deep as the parser's limit.
    [[nodiscard]] std::optional<std::string> FindOrNullRecursive( // NOLINT(misc-no-recursion)
        const Value* valueOrNull,
        const Value& pattern,
        const std::string& path) const
    {
        if (pattern.IsNull() && (valueOrNull == nullptr || valueOrNull->IsNull()))
        {
            return std::nullopt;
        }
        if (valueOrNull == nullptr)
        {
            return Describe(path, pattern, "nothing");
        }
        if (pattern.IsObject() && valueOrNull->IsObject())
        {
            return FindInObjectOrNullRecursive(*valueOrNull, pattern, path);
        }
        if (pattern.IsArray() && valueOrNull->IsArray() && pattern.Size() == valueOrNull->Size())
        {
            return FindInArrayOrNullRecursive(*valueOrNull, pattern, path);
        }
        return IsSameLeaf(*valueOrNull, pattern)
            ? std::nullopt
            : std::optional(Describe(path, pattern, Json::ShortenForError(*valueOrNull)));
    }

private:
    [[nodiscard]] std::optional<std::string> FindInObjectOrNullRecursive( // NOLINT(misc-no-recursion)
        const Value& object,
        const Value& pattern,
        const std::string& path) const
    {
        for (const auto& member : pattern.GetObject())
        {
            const auto found = object.FindMember(member.name);
            std::optional<std::string> mismatch = FindOrNullRecursive(
                found == object.MemberEnd() ? nullptr : &found->value,
                member.value,
                MakePath(path, GetTextView(member.name)));
            if (mismatch.has_value())
            {
                return mismatch;
            }
        }
        return std::nullopt;
    }

    [[nodiscard]] std::optional<std::string> FindInArrayOrNullRecursive( // NOLINT(misc-no-recursion)
        const Value& array,
        const Value& pattern,
        const std::string& path) const
    {
        for (rapidjson::SizeType i = 0; i < pattern.Size(); ++i)
        {
            std::optional<std::string> mismatch =
                FindOrNullRecursive(&array[i], pattern[i], fmt::format("{}[{}]", path, i));
            if (mismatch.has_value())
            {
                return mismatch;
            }
        }
        return std::nullopt;
    }

    [[nodiscard]] bool IsSameLeaf(const Value& value, const Value& pattern) const
    {
        if (pattern.IsString())
        {
            const std::string wanted = FillPlaceholders(GetTextView(pattern), _read);
            return value.IsString() ? MatchesGlob(GetTextView(value), wanted) : wanted == "*" && !value.IsNull();
        }
        return !pattern.IsObject() && !pattern.IsArray() && value == pattern;
    }

    [[nodiscard]] std::string Describe(const std::string& path, const Value& pattern, std::string_view found) const
    {
        const std::string wanted = pattern.IsString() ? FillPlaceholders(GetTextView(pattern), _read) : std::string();
        return fmt::format(
            "{}: expected {}, found {}",
            path,
            pattern.IsString() ? "\"" + wanted + "\"" : Json::ShortenForError(pattern),
            found);
    }
};

} // namespace

std::string FillPlaceholders(std::string_view text, const PlaceholderReader& read)
{
    std::string filled;
    while (!text.empty())
    {
        const std::size_t start = text.find('{');
        const std::size_t end = start == std::string_view::npos ? start : text.find('}', start);
        if (end == std::string_view::npos)
        {
            break;
        }
        const std::optional<std::string> value = read(text.substr(start + 1, end - start - 1));
        // What is no placeholder is text; another one may begin right behind its brace.
        const std::size_t taken = value.has_value() ? end + 1 : start + 1;
        filled += value.has_value() ? text.substr(0, start) : text.substr(0, taken);
        filled += value.value_or("");
        text.remove_prefix(taken);
    }
    filled += text;
    return filled;
}

Core::JsonText FillPlaceholders(const Core::JsonText& json, const PlaceholderReader& read)
{
    Json::JsonDocument document;
    const Core::Result<const Value*> value = document.Parse(json.GetText(), {});
    if (!value.has_value())
    {
        return json;
    }
    std::string filled;
    Json::JsonWriter writer(filled);
    WriteFilledRecursive(**value, read, writer);
    return Core::JsonText::FromTrusted(std::move(filled));
}

bool MatchesGlob(std::string_view text, std::string_view pattern)
{
    std::size_t inText = 0;
    std::size_t inPattern = 0;
    std::size_t star = std::string_view::npos;
    std::size_t afterStar = 0;
    while (inText < text.size())
    {
        if (inPattern < pattern.size() && pattern[inPattern] == '*')
        {
            star = inPattern++;
            afterStar = inText;
        }
        else if (inPattern < pattern.size() && pattern[inPattern] == text[inText])
        {
            ++inPattern;
            ++inText;
        }
        else if (star != std::string_view::npos)
        {
            // The last star takes one character more.
            inPattern = star + 1;
            inText = ++afterStar;
        }
        else
        {
            return false;
        }
    }
    return pattern.find_first_not_of('*', inPattern) == std::string_view::npos;
}

std::optional<std::string> FindMismatchOrNull(
    std::string_view text,
    const MessagePattern& pattern,
    const PlaceholderReader& read)
{
    Json::JsonDocument message;
    Json::JsonDocument wanted;
    const Core::Result<const Value*> value = message.Parse(text, {});
    const Core::Result<const Value*> members = wanted.Parse(pattern.members.GetText(), {});
    if (!value.has_value() || !members.has_value())
    {
        return "no JSON";
    }
    return Matcher(read).FindOrNullRecursive(*value, **members, {});
}

} // namespace ACS::McsSim
