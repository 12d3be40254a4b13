#include "operator/OperatorAnswer.hpp"

#include <acs/core/JsonText.hpp>
#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

namespace ACS::Acsd
{

namespace
{

Apps::HttpResponse MakeSentence(unsigned status, std::string_view key, std::string_view sentence)
{
    Apps::HttpResponse response{status, "application/json", fmt::format("{{\"{}\":", key)};
    Core::JsonText::AppendString(sentence, response.body);
    response.body += "}\n";
    return response;
}

} // namespace

Apps::HttpResponse MakeOperatorError(unsigned status, std::string_view sentence)
{
    return MakeSentence(status, "error", sentence);
}

Apps::HttpResponse RefuseUnknown(std::string_view kind, std::string_view id)
{
    return MakeOperatorError(
        OperatorCode::NOT_FOUND,
        fmt::format("There is no {} {}; /v1/{}s and acsctl {}s list them.", kind, Core::QuoteForError(id), kind, kind));
}

Apps::HttpResponse MakeAccepted(std::string_view sentence)
{
    return MakeSentence(OperatorCode::ACCEPTED, "message", sentence);
}

Apps::HttpResponse MakeJsonAnswer(std::string body)
{
    return {OperatorCode::OK, "application/json", std::move(body)};
}

std::optional<std::string> FindUnexpectedParameterOrNull(
    const Apps::HttpRequest& request,
    std::initializer_list<std::string_view> known)
{
    std::set<std::string_view> seen;
    for (const auto& [name, value] : request.query)
    {
        if (std::ranges::find(known, name) == known.end())
        {
            return known.size() == 0
                ? fmt::format("Unknown parameter {}; this request has no parameters.", Core::QuoteForError(name))
                : fmt::format("Unknown parameter {}; known: {}.", Core::QuoteForError(name), fmt::join(known, ", "));
        }
        if (!Core::JsonText::IsUtf8(value))
        {
            return fmt::format("The parameter {} is not valid UTF-8, found {}.", name, Core::QuoteForError(value));
        }
        if (!seen.insert(name).second)
        {
            return fmt::format("The parameter {} is given twice.", name);
        }
    }
    return std::nullopt;
}

} // namespace ACS::Acsd
