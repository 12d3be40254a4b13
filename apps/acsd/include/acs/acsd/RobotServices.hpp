#pragma once

#include <acs/acsd/IMqttService.hpp>
#include <acs/acsd/IOpenStreamService.hpp>
#include <acs/acsd/IRobotMetrics.hpp>
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/plan/IRobotAdapter.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <cstdint>
#include <functional>
#include <string_view>

namespace ACS::Acsd
{

/// Direction of a message in the trace.
enum class ETraceDirection : std::uint8_t
{
    In,  ///< From the robot.
    Out, ///< To the robot.
};

/// What acsd provides to a robot. Everything referred to outlives the robot. All calls are made on the executor's thread.
struct RobotServices
{
    /// Calls functions of the adapter, and appends what they append to out.
    using AdapterCall = std::function<void(Core::Now now, Planning::AdapterActions& out)>;

    boost::asio::any_io_executor executor; ///< Runs on one thread, which must never be blocked.
    Core::IClock& clock;                   ///< The system's clocks.
    Core::IRandom& random;                 ///< For the jitter of reconnects; not for secrets.
    Core::Logger logger;                   ///< Adds nothing: name the robot in the fields.
    IRobotMetrics& metrics;                ///< Those of this robot alone.
    /// Calls the function with the current time and executes the actions that it appends, then calls IRobot::OnAdapterCalled.
    /// Every call of the adapter goes through it, except those of acsd itself. Has no effect after Stop.
    std::function<void(const AdapterCall& adapterCall)> call;
    /// Adds a message as it was on the wire to the trace of acsd (--trace). Never empty; has no effect without a trace.
    std::function<void(ETraceDirection direction, std::string_view text)> trace;
    /// Makes clients of Open Stream for the robot.
    IOpenStreamService& openStream;
    /// The broker; null without RobotCapabilities::topicPrefix.
    IMqttService* mqttOrNull = nullptr;
    /// Whether a message may be sent to the robot at this moment. With a shared store acsd leads for a time only, and a process that has
    /// stalled must send nothing later: a driver with a connection of its own asks before each message. Never empty.
    std::function<bool()> mayCommand = [] {
        return true;
    };
};

} // namespace ACS::Acsd
