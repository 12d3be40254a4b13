#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <string_view>

namespace ACS::Fuzz
{

/// The bytes of libFuzzer as text.
[[nodiscard]] inline std::string_view AsText(const std::uint8_t* data, std::size_t size)
{
    return {reinterpret_cast<const char*>(data), size}; // NOLINT(cppcoreguidelines-pro-type-reinterpret-cast)
}

/// Ends the run as a finding if the rule is violated, in release builds too.
inline void Require(bool bHolds, std::string_view rule)
{
    if (!bHolds)
    {
        std::fprintf(stderr, "broken rule: %.*s\n", static_cast<int>(rule.size()), rule.data());
        std::abort();
    }
}

} // namespace ACS::Fuzz
