#pragma once

#include "vda-sim/LoadHandling.hpp"
#include "vda-sim/VehicleProfile.hpp"
#include <acs/core/Result.hpp>
#include <acs/vda5050/EVda5050Version.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::VdaSim
{

/// A place on the map, in metres.
struct StartPosition
{
    double x = 0.0;
    double y = 0.0;

    bool operator==(const StartPosition&) const = default;
};

/// One `--vehicle NAME[,type=LR|CR][,node=NODEID][,position=X:Y][,protocol=VERSION][,battery=PERCENT][,profile=NAME]` with the keys of
/// LOAD_HANDLING_KEYS.
struct VehicleSpec
{
    std::string name; ///< The serialNumber.
    EVehicleType type = EVehicleType::Logistics;
    std::optional<std::string> startNodeID;          ///< Absent: as GetStartNode selects.
    std::optional<VDA5050::EVda5050Version> version; ///< Absent: that of --protocol.
    double charge = 100.0;                           ///< %
    LoadHandling handling{};
    std::optional<StartPosition> startPosition{}; ///< Absent: that of the node.
    std::optional<EVehicleProfile> profile{};     ///< Absent: that of --profile.

    bool operator==(const VehicleSpec&) const = default;
};

/// Text that is valid as one level of a topic: VDA5050, section 6.3, and printable characters only.
constexpr std::string_view PLAIN_LEVEL = "a word without blanks, /, +, # and $";
[[nodiscard]] bool IsPlainLevel(std::string_view text);

/// Fails with ECoreError::InvalidIdentifier (a name that is not valid in a topic), UnknownWord (a key, a type or a version)
/// or OutOfRange.
[[nodiscard]] Core::Result<VehicleSpec> ParseVehicleSpec(std::string_view text);

/// "LR" or "CR". Fails with ECoreError::UnknownWord.
[[nodiscard]] Core::Result<EVehicleType> ParseVehicleType(std::string_view text);

/// "2.0.0" or "2.1.0". Fails with ECoreError::UnknownWord.
[[nodiscard]] Core::Result<VDA5050::EVda5050Version> ParseProtocol(std::string_view text);

/// The prefix and the number, from 1: "LR01", with as many digits as the count has, and at least two.
[[nodiscard]] std::string MakeVehicleName(std::string_view prefix, std::size_t number, std::size_t count);

/// "LR" or "CR".
[[nodiscard]] std::string_view GetTypeText(EVehicleType type);

} // namespace ACS::VdaSim
