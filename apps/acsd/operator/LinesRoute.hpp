#pragma once

#include "common/http/HttpMessage.hpp"
#include "common/trace/NewestLines.hpp"

#include <tl/expected.hpp>

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// Of a query `limit`.
constexpr std::size_t MOST_SHOWN_LINES = 1'000;

/// The query `limit` of the request (1 to MOST_SHOWN_LINES, default 100). The error is a sentence; a parameter that is not among the
/// known ones is one.
[[nodiscard]] tl::expected<std::size_t, std::string> ReadLineLimit(
    const Apps::HttpRequest& request,
    std::initializer_list<std::string_view> known);

/// 200 with the newest lines as NDJSON, at most this number.
[[nodiscard]] Apps::HttpResponse MakeLines(const Apps::NewestLines& lines, std::size_t limit);

/// The newest lines, as many as the query `limit` demands; other parameters are refused.
[[nodiscard]] Apps::HttpResponse RespondWithLines(const Apps::HttpRequest& request, const Apps::NewestLines& lines);

} // namespace ACS::Acsd
