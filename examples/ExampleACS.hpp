#pragma once

#include <acs/core/Overloaded.hpp>
#include <acs/plan/IRobotAdapter.hpp>
#include <acs/plan/MemoryPlanStore.hpp>
#include <acs/plan/PlanEngine.hpp>
#include <acs/plan/PlanEngineHost.hpp>

#include <fmt/core.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <variant>

/// Joins a plan engine, a store and one robot in virtual time. A program does the same with real timers, the store on disk
/// and reports that go to the MCS.
class ExampleACS : private ACS::Core::IClock
{
    using Timer = std::variant<ACS::Planning::EngineTimer, ACS::Planning::AdapterTimerID>;

    ACS::Core::Now _now;
    std::string _robotID;
    ACS::Planning::IRobotAdapter& _robot;
    ACS::Planning::MemoryPlanStore _store;
    ACS::Planning::PlanEngine _engine;
    ACS::Planning::PlanEngineHost _host;
    std::map<Timer, ACS::Core::SteadyTime> _timers; ///< When each is due.
    bool _bCompleted = false;

public:
    /// The random source and the robot outlive the host.
    ExampleACS(
        ACS::Planning::EngineOptions options,
        ACS::Planning::SiteMap site,
        ACS::Core::IRandom& random,
        std::string robotID,
        ACS::Planning::IRobotAdapter& robot)
        : _robotID(std::move(robotID)),
          _robot(robot),
          _engine(RejectActions(std::move(options), robot), std::move(site), random),
          _host(
              _engine,
              *this,
              [this](const ACS::Planning::EngineAction& action) { Execute(action); },
              [this](const ACS::Planning::StoreBatch& batch) { _host.OnStored(_store.Append(batch)); })
    {
    }

    /// Once, at start, the adapter lists the actions that it rejects: the MCS gets the reason, and no plan fails half-way.
    [[nodiscard]] static ACS::Planning::EngineOptions RejectActions(
        ACS::Planning::EngineOptions options,
        const ACS::Planning::IRobotAdapter& robot)
    {
        ACS::Planning::RobotOptions& only = options.robots.front();
        only.rejectedActions = ACS::Planning::FindRejectedActions(robot, only.type, options.actions);
        return options;
    }

    void Submit(ACS::Planning::Plan plan)
    {
        _host.Push(ACS::Planning::SubmitPlan{std::move(plan), 0});
    }

    /// Executes what the adapter returned.
    void Run(const ACS::Planning::AdapterActions& actions)
    {
        for (const ACS::Planning::AdapterAction& action : actions)
        {
            Execute(action);
        }
    }

    /// Time jumps to the next timer. False: there is none.
    [[nodiscard]] bool TryAdvance()
    {
        const auto next = std::min_element(_timers.begin(), _timers.end(), [](const auto& left, const auto& right) {
            return left.second < right.second;
        });
        if (next == _timers.end())
        {
            return false;
        }
        const Timer timer = next->first;
        _now.steady = next->second;
        _timers.erase(next);
        std::visit(
            ACS::Core::Overloaded{
                [this](const ACS::Planning::EngineTimer& typed) { _host.Push(typed); },
                [this](ACS::Planning::AdapterTimerID typed) {
                    ACS::Planning::AdapterActions actions;
                    _robot.OnTimer(typed, _now, actions);
                    Run(actions);
                }},
            timer);
        return true;
    }

    [[nodiscard]] bool IsCompleted() const noexcept
    {
        return _bCompleted;
    }

private:
    [[nodiscard]] ACS::Core::Now GetNow() const override
    {
        return _now;
    }

    void Execute(const ACS::Planning::EngineAction& action)
    {
        using namespace ACS::Planning; // NOLINT(google-build-using-namespace): eight actions in a row
        std::visit(
            ACS::Core::Overloaded{
                [](const StorePlans&) { /* executed by the host */ },
                [this](const CommandRobot& typed) {
                    AdapterActions actions;
                    _robot.Handle(typed.command, _now, actions);
                    Run(actions);
                },
                [this](const StartEngineTimer& start) { _timers[start.timer] = _now.steady + start.delay; },
                [this](const CancelEngineTimer& cancel) { _timers.erase(cancel.timer); },
                [this](const SendReport& send) { Show(send.entry.report); },
                [](const ReplyCommand& reply) { fmt::print("plan {}\n", reply.bAccepted ? "accepted" : "refused"); },
                [](const TscStateChanged& typed) { fmt::print("TSC: {}\n", GetText(typed.state)); },
                [](const RobotStatusChanged& typed) {
                    fmt::print("status: {}\n", GetText(typed.status.status));
                }},
            action);
    }

    void Execute(const ACS::Planning::AdapterAction& action)
    {
        std::visit(
            ACS::Core::Overloaded{
                [this](const ACS::Planning::RaiseEvent& raise) {
                    _host.Push(ACS::Planning::RobotInput{_robotID, raise.event});
                },
                [this](const ACS::Planning::StartAdapterTimer& start) {
                    _timers[start.timer] = _now.steady + start.delay;
                },
                [this](const ACS::Planning::CancelAdapterTimer& cancel) {
                    _timers.erase(cancel.timer);
                }},
            action);
    }

    void Show(const ACS::Planning::Report& report)
    {
        if (const auto* reportOrNull = std::get_if<ACS::Planning::PlanReport>(&report))
        {
            fmt::print("report: {} {}\n", reportOrNull->planID, GetText(reportOrNull->state));
            _bCompleted = reportOrNull->state == ACS::Planning::EPlanState::Completed;
        }
    }
};
