#pragma once

#include <acs/core/Now.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Apps
{

/// The members of a line of a trace (docs/reference/trace.md). Those that are empty are omitted.
struct TraceLine
{
    std::string_view link; ///< "mcs", "mqtt", "arm", …
    bool bIn = false;      ///< To the program that writes the trace.
    std::string_view text; ///< Any bytes.
    std::string_view robotID{};
    std::string_view planID{};
    std::string_view transactionID{};
    std::string_view topic{};
    std::string_view kind{};
    std::size_t depth = 0;                     ///< 0: omitted.
    std::optional<std::uint64_t> connection{}; ///< Of a server: its number.
    std::string_view program{};                ///< That writes the trace; omitted by acsd.
    std::optional<std::uint64_t> controller{}; ///< Of openstream-sim: its number.
};

/// One line of JSON, without its end. In text that is not valid UTF-8, \xNN is written for each invalid byte, each backslash is
/// doubled, and the line has "escaped":true.
[[nodiscard]] std::string MakeTraceLine(const TraceLine& line, Core::Now now);

/// The line that states a number of lost lines. The program as in TraceLine.
[[nodiscard]] std::string MakeLossLine(std::string_view program, std::uint64_t count, Core::Now now);

/// The value of the first member of this name in a JSON text that is a string without escapes; empty: there is none. Does not parse
/// the text.
[[nodiscard]] std::string_view FindTextMember(std::string_view text, std::string_view name);

} // namespace ACS::Apps
