#pragma once

#include "control/ChargingControl.hpp"
#include "control/ControlAnswers.hpp"
#include "control/LoadWatch.hpp"
#include "control/RejectionWatch.hpp"
#include "control/StallWatch.hpp"
#include "control/TscControl.hpp"
#include "dispatch/Dispatcher.hpp"
#include "dispatch/StatusPublisher.hpp"
#include "dispatch/WaitWatch.hpp"
#include "engine/OperatorCommands.hpp"
#include "engine/PlanSubmission.hpp"
#include "engine/RestartRecovery.hpp"
#include "engine/StoreGate.hpp"
#include "traffic/PlaceTracker.hpp"
#include "traffic/TrafficCoordinator.hpp"
#include "traffic/WaitingRobots.hpp"
#include "transaction/EngineState.hpp"
#include "work/DriveOutcomes.hpp"
#include "work/JobOutcomes.hpp"
#include "work/PlanControls.hpp"
#include "work/PlanWork.hpp"
#include <acs/plan/PlanEngine.hpp>

namespace ACS::Planning
{

/// Owns the parts. Routes each input to the part that handles it, dispatches until nothing is left to do, and commits the
/// call. A part calls only the parts that are declared before it. The functions of PlanEngine use the parts directly.
class PlanEngine::Impl
{
    friend class PlanEngine;

    EngineState _engine;
    TscControl _tsc;
    ControlAnswers _answers;
    ChargingControl _charging;
    LoadWatch _loads;
    StallWatch _stalls;
    RejectionWatch _rejections;
    PlaceTracker _places;
    WaitingRobots _waiting;
    TrafficCoordinator _coordinator;
    Dispatcher _dispatcher;
    WaitWatch _waits;
    StatusPublisher _status;
    PlanWork _work;
    JobOutcomes _jobs;
    PlanControls _controls;
    DriveOutcomes _drives;
    PlanSubmission _submission;
    OperatorCommands _operator;
    RestartRecovery _recovery;
    StoreGate _store;

public:
    Impl(EngineOptions options, SiteMap site, Core::IRandom& random);

private:
    void Begin(Core::Now now);
    void HandleCommand(const PlanCommand& command);
    void HandleEvent(Robot& robot, const RobotEvent& event);
    /// What a timer does besides OnRobotTimer.
    void OnEngineTimer(EEngineTimer kind);
    void Dispatch();
    void AssignPlans();
    /// Gives plans of robots that reject their commands to other robots.
    void HandOverPlans();
    void End(EngineActions& out);
    void OnRobotTimer(EEngineTimer kind, Robot& robot);
    void OnLink(Robot& robot, const LinkChanged& event);
    void OnState(Robot& robot, const StateChanged& event);
};

} // namespace ACS::Planning
