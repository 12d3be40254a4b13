#pragma once

#include "api/ApiTypes.hpp"
#include <acs/core/Result.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace ACS::Acsctl
{

/// Longest answer that is read.
constexpr std::size_t MAX_ANSWER_BYTES = 32U * 1024U * 1024U;

/// Decodes an answer of the API (T: a type of ApiTypes.hpp that is an answer, an event or a line). Any text gives a value or an
/// error with its JSON path. Members that this version does not know are ignored.
template <typename T>
[[nodiscard]] Core::Result<T> DecodeAnswer(std::string_view text);

/// The JSON document on one line: as it is, or without the blanks between its parts if it has several lines. An error if the
/// text is not one JSON document.
[[nodiscard]] Core::Result<std::string> MakeOneLine(std::string_view text);

} // namespace ACS::Acsctl
