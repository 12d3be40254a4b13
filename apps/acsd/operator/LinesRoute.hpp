#pragma once

#include "common/http/HttpMessage.hpp"
#include "common/trace/NewestLines.hpp"

#include <cstddef>

namespace ACS::Acsd
{

/// Of a query `limit`.
constexpr std::size_t MOST_SHOWN_LINES = 1'000;

/// The newest lines as NDJSON, as many as the query `limit` of the request demands (1 to MOST_SHOWN_LINES, default 100).
[[nodiscard]] Apps::HttpResponse RespondWithLines(const Apps::HttpRequest& request, const Apps::NewestLines& lines);

} // namespace ACS::Acsd
