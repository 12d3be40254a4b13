#pragma once

#include <acs/core/Api.hpp>

#include <cstdint>
#include <string_view>

namespace ACS::OpenStream
{

/// The HTTP methods of the Open API. MONITOR is a Get, CONTROL one of the others.
enum class EApiMethod : std::uint8_t
{
    Get,
    Post,
    Put,
    Delete,
};

/// "GET"
[[nodiscard]] ACS_API std::string_view GetMethodText(EApiMethod method) noexcept;

} // namespace ACS::OpenStream
