#pragma once

#include "robots/LoadPositions.hpp"
#include <acs/plan/RobotEvent.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <string>
#include <vector>

namespace ACS::Acsd
{

/// What a VDA5050 vehicle has reported last, in the engine's terms.
class VehicleReport final
{
    Planning::StateChanged _state;
    bool _bPoseInState = false;         ///< The latest state had a position.
    bool _bPauseDone = false;           ///< startPause was finished later than stopPause.
    std::vector<std::string> _pauseIDs; ///< The finished startPause and stopPause of the latest state.

public:
    /// bJobRunning: the action of the present job runs. Whether the vehicle is occupied is set by SetOccupied.
    void Update(const VDA5050::StateMessage& state, bool bJobRunning, const LoadPositions& positions);
    /// What only messages before the disconnection have shown is not known any more.
    void OnDisconnected();
    /// A position between two states.
    void OnPosition(const VDA5050::AgvPosition& position);
    /// After Update, in addition to the errors of the state.
    void AddErrors(const std::vector<Planning::RobotError>& errors);
    /// After Update: what the robot shows of its commands, instead of the state's orderId.
    void SetShownCommand(std::string commandID);
    /// After Update. An occupied vehicle keeps the released nodes ahead of it.
    void SetOccupied(bool bOccupied, const VDA5050::StateMessage& state);

    [[nodiscard]] const Planning::StateChanged& GetState() const noexcept;

private:
    void UpdatePose(const VDA5050::AgvPosition& position);
    void UpdatePause(const VDA5050::StateMessage& state, bool bJobRunning);
    void UpdateErrors(const VDA5050::StateMessage& state);
};

} // namespace ACS::Acsd
