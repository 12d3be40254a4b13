#pragma once

#include "vda-sim/LoadHandling.hpp"
#include "world/IWorld.hpp"
#include <acs/vda5050/Action.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace ACS::VdaSim
{

/// The load handling device of a vehicle: what is on board, and how it comes there. Over a world it moves the carriers of that,
/// between the stations at which the vehicle is docked and the vehicle's ports; without one every pick and drop finds what it
/// asks for.
class LoadDevice
{
    std::string _robotID;
    LoadHandling _handling;
    std::vector<LoadPosition> _positions;
    Sim::IWorld* _worldOrNull;

    std::vector<VDA5050::Load> _loads;
    std::vector<std::string> _stationIDs; ///< At which the vehicle is docked.

public:
    /// The world outlives it.
    LoadDevice(std::string robotID, EVehicleType type, LoadHandling handling, Sim::IWorld* worldOrNull = nullptr);

    [[nodiscard]] bool IsPick(std::string_view actionType) const;
    [[nodiscard]] bool IsDrop(std::string_view actionType) const;

    /// The work of a pick or a drop: the empty text, or why it failed; nothing has moved then.
    [[nodiscard]] std::string PickUp(const VDA5050::Action& action);
    [[nodiscard]] std::string PutDown(const VDA5050::Action& action);

    /// The vehicle stands at the dock of these stations; none: it has left. The error is the world's.
    [[nodiscard]] Core::Result<void> Dock(std::vector<std::string> stationIDs);

    /// Sees in the world what is on board.
    void UpdateLoads();
    [[nodiscard]] const std::vector<VDA5050::Load>& GetLoads() const noexcept;

private:
    [[nodiscard]] std::string GetText(const VDA5050::Action& action, std::string_view key) const;
    [[nodiscard]] VDA5050::Load MakeLoad(const VDA5050::Action& action) const;
    [[nodiscard]] bool IsFree(std::string_view position) const;
    [[nodiscard]] std::string GetPort(const LoadPosition& position) const;
    /// Sees in the world what is on board; why it cannot be read, or the empty text.
    [[nodiscard]] std::string ReadWorld();
    /// The station that the action names, else the only one here; empty: neither.
    [[nodiscard]] std::string GetStation(const VDA5050::Action& action) const;
    [[nodiscard]] std::string Move(std::string carrierID, std::string from, std::string to);
};

} // namespace ACS::VdaSim
