#include "operator/LinesRoute.hpp"

#include "operator/OperatorAnswer.hpp"
#include <acs/core/ParseNumber.hpp>
#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <optional>
#include <string>
#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr std::size_t DEFAULT_LINES = 100;

} // namespace

tl::expected<std::size_t, std::string> ReadLineLimit(
    const Apps::HttpRequest& request,
    std::initializer_list<std::string_view> known)
{
    if (std::optional<std::string> reason = FindUnexpectedParameterOrNull(request, known))
    {
        return tl::make_unexpected(std::move(*reason));
    }
    const std::string text = request.GetQueryOrNull("limit").value_or(std::to_string(DEFAULT_LINES));
    const std::size_t limit = Core::ParseNumberOrNull<std::size_t>(text).value_or(0);
    if (limit == 0 || limit > MOST_SHOWN_LINES)
    {
        return tl::make_unexpected(
            fmt::format("Expected limit from 1 to {}, found {}.", MOST_SHOWN_LINES, Core::QuoteForError(text)));
    }
    return limit;
}

Apps::HttpResponse MakeLines(const Apps::NewestLines& lines, std::size_t limit)
{
    return {OperatorCode::OK, "application/x-ndjson", lines.GetText(limit)};
}

Apps::HttpResponse RespondWithLines(const Apps::HttpRequest& request, const Apps::NewestLines& lines)
{
    const tl::expected<std::size_t, std::string> limit = ReadLineLimit(request, {"limit"});
    return limit.has_value() ? MakeLines(lines, *limit) : MakeOperatorError(OperatorCode::BAD_REQUEST, limit.error());
}

} // namespace ACS::Acsd
