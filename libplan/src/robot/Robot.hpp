#pragma once

#include "plan/ActivePlan.hpp"
#include "restart/WorkRecord.hpp"
#include "robot/ActiveDrive.hpp"
#include "robot/ChargingPolicy.hpp"
#include "robot/EUnavailability.hpp"
#include "robot/JobTracker.hpp"
#include "robot/ParkingPlaces.hpp"
#include "robot/PauseTracker.hpp"
#include "robot/PortLedger.hpp"
#include "robot/RobotPlace.hpp"
#include "robot/RobotView.hpp"
#include "robot/RouteSearch.hpp"
#include <acs/plan/EngineOptions.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace ACS::Planning
{

enum class EActivity : std::uint8_t
{
    Idle,  ///< No plan.
    Waits, ///< Has a plan and must get to its step's place.
    Works, ///< A job runs.
};

/// What the robot is to confirm of a control of its plan.
struct RobotControl
{
    PauseTracker pause;
    bool bConfirming = false;        ///< The timer ControlConfirm runs.
    bool bStandstillAwaited = false; ///< After a restart: the plan's control is answered once the robot is stationary.
};

/// What may have changed in the present call.
struct RobotChanges
{
    bool bStatus = true;
    bool bWork = false; ///< Its WorkRecord.
};

/// A robot of the fleet: what each part of the engine knows of it.
struct Robot
{
    std::size_t index = 0;
    const RobotOptions* options = nullptr;
    ActivePlan* planOrNull = nullptr;
    EActivity activity = EActivity::Idle;
    RobotView view;
    RobotPlace place;
    ParkingPlaces parking;
    RouteSearch search;
    std::optional<ActiveDrive> drive;
    JobTracker job;
    WorkRecord work;
    RobotControl control;
    PortLedger ports;
    ChargingPolicy charging;
    RobotChanges changes;

    [[nodiscard]] const std::string& GetID() const;
    /// The first that holds, apart from having other work.
    [[nodiscard]] EUnavailability GetUnavailability() const;
    [[nodiscard]] std::string Describe(EUnavailability unavailability) const;
    [[nodiscard]] bool IsUsable() const;
    /// Whether it may be given a plan, as far as the robot itself is concerned.
    [[nodiscard]] bool IsFree() const;
    /// Whether its drive may be extended. A robot without a connection may still report nodes, and then continues.
    [[nodiscard]] bool CanAdvance() const;
    /// Whether its plan is to begin nothing further.
    [[nodiscard]] bool IsHeld() const;
    /// Whether its plan is to be cancelled or aborted.
    [[nodiscard]] bool IsEnding() const;
};

/// Robots with plans in the order of their plans, then those without.
[[nodiscard]] bool IsMoreUrgent(const Robot* left, const Robot* right);

} // namespace ACS::Planning
