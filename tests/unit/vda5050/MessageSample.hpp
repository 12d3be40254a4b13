#pragma once

#include "Catch.hpp"
#include "GoldenFiles.hpp"
#include <acs/vda5050/EVda5050Version.hpp>
#include <acs/vda5050/Topic.hpp>

#include <array>
#include <cstddef>
#include <string>

namespace ACS::VDA5050::Test
{

inline constexpr std::array VERSIONS{EVda5050Version::Version200, EVda5050Version::Version210};

/// "order.2.0.0.full.json"; the variants are full, minimal and null.
inline std::string MakeGoldenName(ETopic topic, EVda5050Version version, const std::string& variant)
{
    return std::string(GetTopicName(topic)) + "." + std::string(GetVersionText(version)) + "." + variant + ".json";
}

inline std::string ReadGolden(ETopic topic, EVda5050Version version, const std::string& variant)
{
    return Testing::ReadGolden(ACS_FIXTURES "/golden", MakeGoldenName(topic, version, variant));
}

inline std::string ReadFull(ETopic topic, EVda5050Version version)
{
    return ReadGolden(topic, version, "full");
}

/// The text with the first `from`, which must be there, as `to`.
inline std::string Replace(std::string text, const std::string& from, const std::string& to)
{
    const std::size_t position = text.find(from);
    REQUIRE(position != std::string::npos);
    return text.replace(position, from.size(), to);
}

} // namespace ACS::VDA5050::Test
