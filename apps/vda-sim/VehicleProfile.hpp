#pragma once

#include <acs/core/Result.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>

#include <chrono>
#include <cstdint>
#include <span>
#include <string_view>

namespace ACS::VdaSim
{

/// Typical makes of vehicles. Each demands or lacks something, and rejects what breaks its rules.
enum class EVehicleProfile : std::uint8_t
{
    Standard,
    StrictLengths,
    NoHorizon,
    ManualClears,
    SlowAccept,
    PartialFactsheet,
    NodeActions,
    Blocking,
    LineGuided,
};

/// What a factsheet cannot state about a make.
struct VehicleTraits
{
    bool bRejectsHorizon = false;
    bool bForgetsInManual = false;         ///< VehicleOptions::bForgetsInManual
    bool bHandlesLoadsInPlaceOnly = false; ///< Node of a pick or a drop: at the vehicle's position, not only near it.
    bool bReportsPosition = true;          ///< False: no agvPosition, velocity, maps or visualization.
    std::chrono::milliseconds acceptanceTime{}; ///< From the arrival of an order to its acceptance or rejection.
};

struct VehicleProfile
{
    EVehicleProfile profile = EVehicleProfile::Standard;
    std::string_view name;        ///< As --profile has it.
    std::string_view description; ///< One line, for --help.
    VehicleTraits traits{};
    /// Changes the factsheet of a vehicle without a profile; null: not.
    void (*adaptOrNull)(VDA5050::FactsheetMessage& factsheet) = nullptr;
};

/// All of them, Standard first.
[[nodiscard]] std::span<const VehicleProfile> GetProfiles();
[[nodiscard]] const VehicleProfile& GetProfile(EVehicleProfile profile);

/// Reads the name of a profile. Fails with ECoreError::UnknownWord.
[[nodiscard]] Core::Result<EVehicleProfile> ParseProfile(std::string_view text);

} // namespace ACS::VdaSim
