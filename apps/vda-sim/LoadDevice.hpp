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

/// The load handling device of a vehicle and the loads on board. With a world it moves the world's carriers between the
/// stations at which the vehicle is docked and the vehicle's ports; without one every pick and drop finds its load.
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

    /// Performs a pick or a drop. Returns an empty text, or why it failed; nothing has moved then.
    [[nodiscard]] std::string PickUp(const VDA5050::Action& action);
    [[nodiscard]] std::string PutDown(const VDA5050::Action& action);

    /// The vehicle is docked at these stations; empty: it has left. The error is the world's.
    [[nodiscard]] Core::Result<void> Dock(std::vector<std::string> stationIDs);

    /// Reads the loads on board from the world.
    void UpdateLoads();
    [[nodiscard]] const std::vector<VDA5050::Load>& GetLoads() const noexcept;

private:
    [[nodiscard]] std::string GetText(const VDA5050::Action& action, std::string_view key) const;
    [[nodiscard]] VDA5050::Load MakeLoad(const VDA5050::Action& action) const;
    [[nodiscard]] bool IsFree(std::string_view position) const;
    [[nodiscard]] std::string GetPort(const LoadPosition& position) const;
    /// Reads the loads on board from the world. Returns an empty text, or why the world cannot be read.
    [[nodiscard]] std::string ReadWorld();
    /// The station that the action names, else the only one at this node; empty if there is neither.
    [[nodiscard]] std::string GetStation(const VDA5050::Action& action) const;
    [[nodiscard]] std::string Move(std::string carrierID, std::string from, std::string to);
};

} // namespace ACS::VdaSim
