#pragma once

#include "common/ConfigDocument.hpp"

#include <tl/expected.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace ACS::Apps
{

/// Why a text is no TOML.
struct TomlMistake
{
    std::uint32_t line = 0;
    std::string text;
};

/// Reads TOML into nodes. The only place that knows toml++.
[[nodiscard]] tl::expected<ConfigNode, TomlMistake> ParseToml(std::string_view text, bool bOverride);

} // namespace ACS::Apps
