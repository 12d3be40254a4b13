#pragma once

#include <acs/acsd/RobotAction.hpp>
#include <acs/core/Api.hpp>
#include <acs/core/Now.hpp>
#include <acs/plan/IRobotAdapter.hpp>

#include <tl/expected.hpp>

#include <string>
#include <vector>

namespace ACS::Acsd
{

/// The instant actions of a robot that operators may request: `/v1/robots/ID/actions`, `acsctl action`. An optional capability of an
/// IRobot. acsd keeps the last actions and their outcomes, and publishes them; the plan engine does not know of them, so an action
/// must neither move the robot nor change its carriers. They are not stored: after a restart of acsd none is repeated.
class ACS_API IRobotActions
{
public:
    IRobotActions() = default;
    IRobotActions(const IRobotActions&) = delete;
    IRobotActions& operator=(const IRobotActions&) = delete;
    virtual ~IRobotActions() = default;

    /// What Request accepts at present; may be empty.
    [[nodiscard]] virtual std::vector<RobotActionOffer> ListOffers() const = 0;

    /// Validates the request and sends it once the call has ended; its status is Waiting. The result is an id of the action, which the
    /// robot has not used since the start of acsd. Called as a function of RobotServices::call: it may append to out.
    [[nodiscard]] virtual tl::expected<std::string, RobotActionRefusal> Request(
        const RobotActionRequest& request,
        Core::Now now,
        Planning::AdapterActions& out) = 0;

    /// The changes since the last call, in their order. Called after each IRobot::OnAdapterCalled.
    [[nodiscard]] virtual std::vector<RobotActionChange> TakeChanges() = 0;
};

} // namespace ACS::Acsd
