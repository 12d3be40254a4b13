#pragma once

#include <acs/core/ECoreError.hpp>

#include <tl/expected.hpp>

#include <string>
#include <string_view>
#include <system_error>

namespace ACS::Core
{

/// Why something that came from outside was refused: what is wrong, where, and what would have been right.
struct Error
{
    std::error_code code; ///< For programs: compare with an E…Error enumerator.
    std::string path;     ///< Where: a JSON path ("payload.steps[0].position"), empty for the whole.
    std::string expected; ///< What would have been accepted ("a location", "an integer from 1 to 100").
    std::string found;    ///< What came instead, shortened; never bytes that are no UTF-8.

    bool operator==(const Error&) const = default;
};

/// One sentence for a log line or for the message of an acknowledgement.
[[nodiscard]] std::string Describe(const Error& error);

/// A value or the reason why there is none. std::expected, one day.
template <typename TValue>
using Result = tl::expected<TValue, Error>;

/// Makes the unexpected side of a Result: `return Fail(ECoreError::OutOfRange, "payload.x", "…", "…");`
[[nodiscard]] tl::unexpected<Error> Fail(
    std::error_code code,
    std::string path = {},
    std::string expected = {},
    std::string found = {});

/// Text from outside as Error::found shows it: in quotes, cut after 64 characters, '?' for what is not printable ASCII.
[[nodiscard]] std::string QuoteForError(std::string_view text);

} // namespace ACS::Core
