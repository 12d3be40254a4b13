#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Now.hpp>
#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/ERobotType.hpp>
#include <acs/plan/RobotCommand.hpp>
#include <acs/plan/RobotEvent.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace ACS::Planning
{

/// A timer of an adapter. The adapter chooses the number.
using AdapterTimerID = std::uint32_t;

/// Pass the event to the engine.
struct RaiseEvent
{
    RobotEvent event; ///< Of the adapter's own robot.

    bool operator==(const RaiseEvent&) const = default;
};

/// Call OnTimer after the delay. A running timer of the same number is restarted.
struct StartAdapterTimer
{
    AdapterTimerID timer = 0;
    Core::Duration delay{};

    bool operator==(const StartAdapterTimer&) const = default;
};

/// Do not call OnTimer for this timer.
struct CancelAdapterTimer
{
    AdapterTimerID timer = 0;

    bool operator==(const CancelAdapterTimer&) const = default;
};

/// What an adapter requests of its host.
using AdapterAction = std::variant<RaiseEvent, StartAdapterTimer, CancelAdapterTimer>;
/// To be executed in order.
using AdapterActions = std::vector<AdapterAction>;

/// Connects one robot to the engine: executes its commands and reports its events. An implementation does no I/O and reads
/// no clock; it has its own outputs for messages to its robot. Calls append to out, which the caller owns. Called by one
/// thread at a time. docs/guide/write-an-adapter.md lists the rules, which ACS::AdapterTest checks.
class ACS_API IRobotAdapter
{
public:
    IRobotAdapter() = default;
    IRobotAdapter(const IRobotAdapter&) = delete;
    IRobotAdapter& operator=(const IRobotAdapter&) = delete;
    virtual ~IRobotAdapter() = default;

    /// Executes the command. RobotCommand.hpp states the events that answer it. They may be in out or follow in a later call.
    /// If the robot is disconnected, they follow when it is connected again: the engine does not repeat the command.
    virtual void Handle(const RobotCommand& command, Core::Now now, AdapterActions& out) = 0;

    /// A timer has expired and was neither cancelled nor restarted since.
    virtual void OnTimer(AdapterTimerID timer, Core::Now now, AdapterActions& out) = 0;

    /// Why this robot cannot execute the action, in a sentence for the MCS; nullopt if it can. Called once at start
    /// (FindRejectedActions): depends only on the configuration. JobCheckChanged covers what changes later.
    [[nodiscard]] virtual std::optional<std::string> GetRejectionReasonOrNull(std::string_view action) const = 0;
};

/// The actions of the robot's type that its adapter rejects, for RobotOptions::rejectedActions.
[[nodiscard]] ACS_API RejectedActions
FindRejectedActions(const IRobotAdapter& adapter, ERobotType type, const ActionTable& actions);

} // namespace ACS::Planning
