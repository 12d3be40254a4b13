#pragma once

#include <acs/core/Result.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace ACS::Sim
{

/// Maximum length of the name of a carrier or station in bytes.
constexpr std::size_t MAX_NAME = 256;

/// Checks the name of a carrier or station: 1 to MAX_NAME bytes of UTF-8 without control characters. Fails with
/// EWorldError::InvalidName.
[[nodiscard]] Core::Result<void> CheckName(std::string_view name);
/// Checks the name of a robot. Fails with EWorldError::InvalidName, also for the alias AMR.
[[nodiscard]] Core::Result<void> CheckRobotName(std::string_view robotID);
/// Returns a place in its canonical spelling, any other name unchanged.
[[nodiscard]] std::string MakeCanonical(std::string_view name);

} // namespace ACS::Sim
