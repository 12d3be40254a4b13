#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Now.hpp>
#include <acs/plan/IRobotAdapter.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// The pure adapter of a robot that speaks lines over TCP: no I/O, no clock. LineRobot connects it.
class ACS_API ILineAdapter : public Planning::IRobotAdapter
{
public:
    /// The connection is open. The robot may have missed the last lines of the previous connection, and acsd those of the robot.
    virtual void OnLinkUp(Core::Now now, Planning::AdapterActions& out) = 0;

    /// The connection is lost. Once per OnLinkUp.
    virtual void OnLinkDown(Core::Now now, Planning::AdapterActions& out) = 0;

    /// A line of the robot without its end: valid UTF-8 without control characters, at most LineClientOptions::maximumLineBytes.
    virtual void OnLine(std::string_view line, Core::Now now, Planning::AdapterActions& out) = 0;

    /// The lines to be sent, without their ends, in order; they are removed. Called after every call of the adapter. While there is
    /// no connection they are discarded.
    [[nodiscard]] virtual std::vector<std::string> TakeLines() = 0;

    /// Does nothing: for an adapter without timers.
    void OnTimer(Planning::AdapterTimerID /*timer*/, Core::Now /*now*/, Planning::AdapterActions& /*out*/) override
    {
    }

    /// Not called for a driven robot: RobotCapabilities::rejectedActions has the reasons.
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(std::string_view /*action*/) const override
    {
        return std::nullopt;
    }
};

} // namespace ACS::Acsd
