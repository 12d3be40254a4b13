#pragma once

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

/// A timer of an adapter; the adapter gives the numbers.
using AdapterTimerID = std::uint32_t;

/// Tell the engine.
struct RaiseEvent
{
    RobotEvent event;

    bool operator==(const RaiseEvent&) const = default;
};

/// Call OnTimer after the delay; a running timer of this number starts again.
struct StartAdapterTimer
{
    AdapterTimerID timer = 0;
    Core::Duration delay{};

    bool operator==(const StartAdapterTimer&) const = default;
};

struct CancelAdapterTimer
{
    AdapterTimerID timer = 0;

    bool operator==(const CancelAdapterTimer&) const = default;
};

using AdapterAction = std::variant<RaiseEvent, StartAdapterTimer, CancelAdapterTimer>;
using AdapterActions = std::vector<AdapterAction>;

/// Joins one robot to the engine: takes its commands, tells its events. Pure: an implementation does no I/O and reads no
/// clock; what it has to send to its robot leaves by outputs of its own. Calls append to out, which the caller owns.
class IRobotAdapter
{
public:
    IRobotAdapter() = default;
    IRobotAdapter(const IRobotAdapter&) = delete;
    IRobotAdapter& operator=(const IRobotAdapter&) = delete;
    virtual ~IRobotAdapter() = default;

    /// RobotCommand.hpp says what answers each of them. Answers may be in out at once or come by a later call, and a robot that
    /// is out of reach owes them when it is back: the engine does not ask again.
    virtual void Handle(const RobotCommand& command, Core::Now now, AdapterActions& out) = 0;

    /// A timer of StartAdapterTimer has come to its end, and was neither cancelled nor started again since.
    virtual void OnTimer(AdapterTimerID timer, Core::Now now, AdapterActions& out) = 0;

    /// Why this robot cannot do the action, in words for the MCS; nullopt where it can. Asked at start
    /// (FindRejectedActions), so it follows from how the robot is configured, not from how it does (JobCheckChanged).
    [[nodiscard]] virtual std::optional<std::string> GetRejectionReasonOrNull(std::string_view action) const = 0;
};

/// What the adapter's robot cannot do of the actions of its type: for RobotOptions::rejectedActions, before the engine is
/// made.
[[nodiscard]] RejectedActions FindRejectedActions(
    const IRobotAdapter& adapter,
    ERobotType type,
    const ActionTable& actions);

} // namespace ACS::Planning
