#pragma once

#include <system_error>

namespace ACS::Sample
{

/// How an error enumeration looks: numbers that stay, a comment where the name is not enough.
enum class ESampleError
{
    Malformed = 1,
    OutOfRange = 2,
    UnhandledEnum = 3,
};

[[nodiscard]] std::error_code make_error_code(ESampleError error) noexcept;

} // namespace ACS::Sample

template <>
struct std::is_error_code_enum<ACS::Sample::ESampleError> : std::true_type
{
};
