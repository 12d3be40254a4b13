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

/// What the MCS calls the two kinds of robots.
enum class EVehicleType : std::uint8_t
{
    Logistics, ///< LR: carries cassettes.
    Control,   ///< CR: the mobile base of an arm.
};

/// A place on the vehicle that a load can be in.
struct LoadPosition
{
    std::string port; ///< "CP01": as the MCS and the world file name it.
    std::string name; ///< As the vehicle names it: in lhd and in the state.

    bool operator==(const LoadPosition&) const = default;
};

/// What a parameter of the standard's pick and drop is at this make.
struct ParameterForm
{
    std::string name;                                  ///< Empty: this make has no such parameter.
    std::optional<VDA5050::EValueDataType> typeOrNull; ///< Absent: the standard's.

    bool operator==(const ParameterForm&) const = default;
};

/// How a make of vehicles handles loads. By default as the standard has it, with the ports of the vehicle's type.
struct LoadHandling
{
    static constexpr std::size_t MAX_PORTS = 99;

    std::optional<std::size_t> ports;                             ///< Absent: 4 of an LR, none of a CR.
    std::map<std::string, std::string, std::less<>> positions;    ///< Names of ports that are not called as the port.
    std::string pickType = "pick";                                ///< The actionType that means it.
    std::string dropType = "drop";                                ///< The actionType that means it.
    std::map<std::string, ParameterForm, std::less<>> parameters; ///< By the standard's key, where they differ.

    /// Of a parameter that the standard gives this key; empty where this make does not have it.
    [[nodiscard]] std::string_view GetParameterName(std::string_view key) const;

    bool operator==(const LoadHandling&) const = default;
};

/// Where a vehicle of this type carries loads by itself. None on the base of an arm, which carries what the arm has put there.
[[nodiscard]] std::vector<LoadPosition> GetLoadPositions(EVehicleType type, const LoadHandling& handling = {});

/// The standard's row of pick or drop as this make has it.
[[nodiscard]] VDA5050::AgvAction AdaptAction(VDA5050::AgvAction action, const LoadHandling& handling);

/// What the keys of --vehicle for it are.
constexpr std::string_view LOAD_HANDLING_KEYS =
    "ports=N, load=PORT:NAME, pick=ACTIONTYPE, drop=ACTIONTYPE or PARAMETER=[NAME[:TYPE]]";

/// Reads one of these keys; false where it is none. The error's path is the key.
[[nodiscard]] Core::Result<bool> TryReadHandlingKey(
    std::string_view key,
    std::string_view value,
    LoadHandling& handling);

/// Whether what was read fits together.
[[nodiscard]] Core::Result<void> CheckHandling(EVehicleType type, const LoadHandling& handling);

} // namespace ACS::VdaSim
