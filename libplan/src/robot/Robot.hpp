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
#include "robot/RobotChanges.hpp"
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
    Waits, ///< Has a plan and must reach its step's station.
    Works, ///< A job runs.
};

/// What the robot must confirm for the control of its plan.
struct RobotControl
{
    PauseTracker pause;
    bool bConfirming = false;        ///< The timer ControlConfirm runs.
    bool bStandstillAwaited = false; ///< After a restart: the plan's control is answered once the robot is stationary.
};

/// A robot of the fleet: its state, by the part of the engine that keeps it.
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
    /// By the record of its ports; the other load than in reality is possible until its sensors report.
    [[nodiscard]] ELoad GetLoad() const;
    /// The first reason that applies, apart from having other work.
    [[nodiscard]] EUnavailability GetUnavailability() const;
    [[nodiscard]] std::string Describe(EUnavailability unavailability) const;
    [[nodiscard]] bool IsUsable() const;
    /// It rejects all its commands or cannot do them: another robot may take over its plan.
    [[nodiscard]] bool IsUnfit() const;
    /// Whether a plan may be assigned to it. Each condition has its sentence in WaitReasons::DescribeUnfree.
    [[nodiscard]] bool IsFree() const;
    /// Without a drive: whether it still moves on its former route as far as is known, so that its place is not final.
    [[nodiscard]] bool IsStopping() const;
    /// Whether its drive may be extended. A disconnected robot may still report nodes, and then continues.
    [[nodiscard]] bool CanAdvance() const;
    /// Whether its plan is paused or being paused.
    [[nodiscard]] bool IsHeld() const;
    /// Whether its plan is being cancelled or aborted.
    [[nodiscard]] bool IsEnding() const;
};

/// Robots with plans in the order of their plans, then those without.
[[nodiscard]] bool IsMoreUrgent(const Robot* leftOrNull, const Robot* rightOrNull);

} // namespace ACS::Planning
