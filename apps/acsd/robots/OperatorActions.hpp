#pragma once

#include "robots/InstantActionCheck.hpp"
#include "robots/RobotOutputs.hpp"
#include <acs/acsd/RobotAction.hpp>
#include <acs/core/Now.hpp>
#include <acs/plan/IRobotAdapter.hpp>
#include <acs/vda5050/MasterSession.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <tl/expected.hpp>

#include <chrono>
#include <cstddef>
#include <deque>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// The instant actions that operators request from a vehicle: sends the valid ones, and derives their outcome from the vehicle's states.
/// An action that the vehicle does not show soon is not sent any more: it would be performed when the operator no longer expects it. Pure.
class OperatorActions final
{
public:
    static constexpr Planning::AdapterTimerID TIMER = 52;
    /// Maximum time until the vehicle shows an action.
    static constexpr std::chrono::milliseconds SHOW_TIMEOUT{30'000};
    /// Number of actions whose outcome is observed. Of more, the oldest is forgotten.
    static constexpr std::size_t MOST_OBSERVED = 64;

private:
    struct Sent
    {
        RobotActionChange last; ///< As reported.
        Core::SteadyTime sentAt;
        bool bShown = false;
    };

    InstantActionCheck _check;
    RobotOutputs& _outputs;
    std::deque<Sent> _sent; ///< Without an outcome, or Unknown.

public:
    /// The outputs must outlive it, and receive the changes.
    OperatorActions(InstantActionCheck check, RobotOutputs& outputs);

    /// The result is the actionId. Uses timer TIMER.
    [[nodiscard]] tl::expected<std::string, RobotActionRefusal> Send(
        const RobotActionRequest& request,
        VDA5050::MasterSession& session,
        Core::Now now,
        VDA5050::MasterActions& sessionOut,
        Planning::AdapterActions& out);

    void OnState(const VDA5050::StateMessage& state);
    /// The vehicle, or acsd's own link, is disconnected. Actions that the vehicle has shown keep their state until it is back.
    void OnDisconnected(VDA5050::MasterSession& session);
    void OnTimer(VDA5050::MasterSession& session, Core::Now now, Planning::AdapterActions& out);

    /// Whether an operator has requested this action of the vehicle's state.
    [[nodiscard]] bool IsRequested(std::string_view actionID) const;

private:
    void Report(Sent& sent, ERobotActionStatus status, const std::string& resultDescription);
    void Abandon(Sent& sent, VDA5050::MasterSession& session, const std::string& reason);
    void StartTimer(Core::Now now, Planning::AdapterActions& out) const;
};

} // namespace ACS::Acsd
