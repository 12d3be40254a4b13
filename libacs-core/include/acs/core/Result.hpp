#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/ECoreError.hpp>

#include <tl/expected.hpp>

#include <string>
#include <string_view>
#include <system_error>

namespace ACS::Core
{

/// Why a value from outside was rejected: the error, its place, and what would have been valid.
struct Error
{
    std::error_code code; ///< Compare with an E…Error enumerator.
    std::string path;     ///< JSON path ("payload.steps[0].position"); empty for the whole value.
    std::string expected; ///< Valid values ("a location", "an integer from 1 to 100").
    std::string found;    ///< The received value, shortened; always valid UTF-8.

    bool operator==(const Error&) const = default;
};

/// One sentence for a log line or for the message of an acknowledgement.
[[nodiscard]] ACS_API std::string Describe(const Error& error);

/// A value or an error; to be replaced by std::expected.
template <typename TValue>
using Result = tl::expected<TValue, Error>;

/// Creates the error of a Result: `return Fail(ECoreError::OutOfRange, "payload.x", "…", "…");`
[[nodiscard]] ACS_API tl::unexpected<Error> Fail(
    std::error_code code,
    std::string path = {},
    std::string expected = {},
    std::string found = {});

/// Text from outside for Error::found: in quotes, truncated to 64 characters, '?' for characters that are not printable
/// ASCII.
[[nodiscard]] ACS_API std::string QuoteForError(std::string_view text);

} // namespace ACS::Core
