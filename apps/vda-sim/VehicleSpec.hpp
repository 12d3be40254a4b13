#pragma once

#include <acs/core/Result.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::VdaSim
{

/// What the MCS calls the two kinds of robots.
enum class EVehicleType : std::uint8_t
{
    Logistics, ///< LR: carries cassettes.
    Control,   ///< CR: the mobile base of an arm.
};

/// One `--vehicle NAME[,type=LR|CR][,node=NODEID]`.
struct VehicleSpec
{
    std::string name; ///< The serialNumber.
    EVehicleType type = EVehicleType::Logistics;
    std::optional<std::string> startNodeID; ///< Absent: a charger of the site.

    bool operator==(const VehicleSpec&) const = default;
};

/// Fails with ECoreError::InvalidIdentifier (a name that no topic can have) or UnknownWord (a key or a type).
[[nodiscard]] Core::Result<VehicleSpec> ParseVehicleSpec(std::string_view text);

/// "LR" or "CR".
[[nodiscard]] std::string_view GetTypeText(EVehicleType type);

} // namespace ACS::VdaSim
