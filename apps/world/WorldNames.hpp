#pragma once

#include <acs/core/Result.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace ACS::Sim
{

/// Bytes of the name of a carrier or station.
constexpr std::size_t MAX_NAME = 256;

/// A carrier or a station: 1 to MAX_NAME bytes of UTF-8 without control characters. Fails with EWorldError::InvalidName.
[[nodiscard]] Core::Result<void> CheckName(std::string_view name);
/// Fails with EWorldError::InvalidName, also for the alias AMR.
[[nodiscard]] Core::Result<void> CheckRobotName(std::string_view robotID);
/// A place in its canonical spelling; any other name as it is.
[[nodiscard]] std::string MakeCanonical(std::string_view name);

} // namespace ACS::Sim
