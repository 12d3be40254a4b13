#pragma once

#include "common/http/HttpMessage.hpp"
#include "common/trace/NewestLines.hpp"

#include <cstddef>
#include <initializer_list>
#include <string_view>

namespace ACS::Acsd
{

/// Of a query `limit`.
constexpr std::size_t MOST_SHOWN_LINES = 1'000;

/// The newest lines as NDJSON, as many as the query `limit` of the request demands (1 to MOST_SHOWN_LINES, default 100). A
/// parameter that is not among the known ones is refused.
[[nodiscard]] Apps::HttpResponse RespondWithLines(
    const Apps::HttpRequest& request,
    const Apps::NewestLines& lines,
    std::initializer_list<std::string_view> known = {"limit"});

} // namespace ACS::Acsd
