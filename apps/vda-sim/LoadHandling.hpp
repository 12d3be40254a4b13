#pragma once

#include <acs/core/Result.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VdaSim
{

/// The two types of robots of MCS-ACS.
enum class EVehicleType : std::uint8_t
{
    Logistics, ///< LR: carries cassettes.
    Control,   ///< CR: the mobile base of an arm.
};

/// A load position of the vehicle.
struct LoadPosition
{
    std::string port; ///< "CP01": as the MCS and the world file name it.
    std::string name; ///< As the vehicle names it: in lhd and in the state.

    bool operator==(const LoadPosition&) const = default;
};

/// The vehicle's form of a parameter of the standard's pick and drop.
struct ParameterForm
{
    std::string name;                                  ///< Empty: not supported.
    std::optional<VDA5050::EValueDataType> typeOrNull; ///< Absent: the standard's.

    bool operator==(const ParameterForm&) const = default;
};

/// How a vehicle handles loads. By default as in the standard, with the ports of the vehicle's type.
struct LoadHandling
{
    static constexpr std::size_t MAX_PORTS = 99;

    std::optional<std::size_t> ports;                             ///< Absent: 4 of an LR, none of a CR.
    std::map<std::string, std::string, std::less<>> positions;    ///< Names that differ from the port, by port.
    std::string pickType = "pick";                                ///< The actionType of pick.
    std::string dropType = "drop";                                ///< The actionType of drop.
    std::map<std::string, ParameterForm, std::less<>> parameters; ///< Those that differ, by the standard's key.

    /// The vehicle's name of the parameter with this key in the standard; empty if it is not supported.
    [[nodiscard]] std::string_view GetParameterName(std::string_view key) const;

    bool operator==(const LoadHandling&) const = default;
};

/// Load positions of a vehicle of this type. By default none on the base of an arm: the arm handles the loads there.
[[nodiscard]] std::vector<LoadPosition> GetLoadPositions(EVehicleType type, const LoadHandling& handling = {});

/// Adapts the standard's description of pick or drop to this vehicle.
[[nodiscard]] VDA5050::AgvAction AdaptAction(VDA5050::AgvAction action, const LoadHandling& handling);

/// The keys of --vehicle for load handling.
constexpr std::string_view LOAD_HANDLING_KEYS =
    "ports=N, load=PORT:NAME, pick=ACTIONTYPE, drop=ACTIONTYPE or PARAMETER=[NAME[:TYPE]]";

/// Reads one of these keys; false if it is not one of them. The error's path is the key.
[[nodiscard]] Core::Result<bool> TryReadHandlingKey(
    std::string_view key,
    std::string_view value,
    LoadHandling& handling);

/// Checks the keys against each other.
[[nodiscard]] Core::Result<void> CheckHandling(EVehicleType type, const LoadHandling& handling);

} // namespace ACS::VdaSim
