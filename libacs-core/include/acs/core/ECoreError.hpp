#pragma once

#include <system_error>

namespace ACS::Core
{

/// What can be wrong with a value that comes from outside. The numbers are stable: they appear in logs and metrics.
enum class ECoreError
{
    InvalidJson = 1,       ///< The text is no JSON, no UTF-8, or repeats a member name.
    MissingField = 2,      ///< A required member is absent.
    WrongType = 3,         ///< A member has another JSON type than required.
    OutOfRange = 4,        ///< A number, a length or a count lies outside its bounds.
    UnknownWord = 5,       ///< An enumeration has no such word.
    TooLarge = 6,          ///< A text is longer, or nested deeper, than allowed.
    InvalidLocation = 7,   ///< A location does not follow the grammar.
    InvalidTimestamp = 8,  ///< A time is no ISO 8601 date and time.
    InvalidIdentifier = 9, ///< An identifier is empty, too long or has a character that may not be in it.
    QueueFull = 10,        ///< A bounded queue has no room.
    UnhandledEnum = 11,    ///< An enumerator has no case: a defect of this library.
};

[[nodiscard]] std::error_code make_error_code(ECoreError error) noexcept;

} // namespace ACS::Core

template <>
struct std::is_error_code_enum<ACS::Core::ECoreError> : std::true_type
{
};
