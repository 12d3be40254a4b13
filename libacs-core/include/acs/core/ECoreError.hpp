#pragma once

#include <acs/core/Api.hpp>

#include <system_error>

namespace ACS::Core
{

/// Errors of values from outside. The numbers are stable: they appear in logs and metrics.
enum class ECoreError
{
    InvalidJSON = 1,       ///< Not valid JSON or UTF-8, or a repeated member name.
    MissingField = 2,      ///< A required member is absent.
    WrongType = 3,         ///< A member has another JSON type than required.
    OutOfRange = 4,        ///< A number, a length or a count exceeds its limits.
    UnknownWord = 5,       ///< Not a name of the enumeration.
    TooLarge = 6,          ///< A text is longer or nested more deeply than allowed.
    InvalidLocation = 7,   ///< Not a valid location.
    InvalidTimestamp = 8,  ///< Not a valid ISO 8601 date and time.
    InvalidIdentifier = 9, ///< An identifier is empty, too long or has an invalid character.
    QueueFull = 10,        ///< A bounded queue is full.
    UnhandledEnum = 11,    ///< An enumerator without a case: a defect of this library.
};

/// Makes the enumerators convertible to std::error_code.
[[nodiscard]] ACS_API std::error_code make_error_code(ECoreError error) noexcept;

} // namespace ACS::Core

template <>
struct std::is_error_code_enum<ACS::Core::ECoreError> : std::true_type
{
};
