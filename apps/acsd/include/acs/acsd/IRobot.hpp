#pragma once

#include <acs/acsd/IRobotActions.hpp>
#include <acs/core/Api.hpp>
#include <acs/core/Now.hpp>
#include <acs/plan/IRobotAdapter.hpp>

#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// An error that a robot reports, in its own words.
struct DriverError
{
    std::string type;        ///< Of the robot: "batteryFault".
    std::string level;       ///< Of the robot's protocol: "WARNING", "FATAL".
    std::string description; ///< May be empty.

    bool operator==(const DriverError&) const = default;
};

/// What a driver shows of its robot to operators: `/v1/robots`, `acsctl robot`, the live page.
struct DriverDetails
{
    std::vector<std::string> warnings; ///< What its messages contradict, without an alarm; a sentence each.
    /// Whether its arm can be commanded; nullopt for a robot without an arm that has a connection of its own.
    std::optional<bool> bArmUp;
    std::optional<std::string> protocolVersion{};  ///< As the robot reports it: "2.1.0"; nullopt: unknown.
    std::optional<std::string> mode{};             ///< As the robot reports it: "AUTOMATIC"; nullopt: unknown.
    std::vector<DriverError> errors{};             ///< That the robot reports now.
    std::optional<Core::WallTime> lastMessageAt{}; ///< nullopt: it has sent none since the start of acsd.

    bool operator==(const DriverDetails&) const = default;
};

/// One robot: its connection, and the pure adapter that decides. acsd calls both on the executor's thread only. It calls the
/// adapter's Handle and OnTimer, runs its timers and passes its events to the engine.
class ACS_API IRobot
{
public:
    IRobot() = default;
    IRobot(const IRobot&) = delete;
    IRobot& operator=(const IRobot&) = delete;
    virtual ~IRobot() = default;

    /// Owned by the robot, which passes its messages to it by RobotServices::call.
    [[nodiscard]] virtual Planning::IRobotAdapter& GetAdapter() noexcept = 0;

    /// Connects, and reconnects until it is stopped. Called once. The adapter may have been called before: after a restart it
    /// receives RecoverJob first.
    virtual void Start() = 0;

    /// Closes the connection at once. The robot itself is not commanded. The last call.
    virtual void Stop() = 0;

    /// Sends what the adapter wants to send. Called after every call of the adapter, when its actions have been executed.
    virtual void OnAdapterCalled() = 0;

    /// Sets the robot's metrics to their current values. Called before metrics are served, not after Stop.
    virtual void UpdateMetrics() = 0;

    /// Called several times a second, not after Stop; the default shows nothing.
    [[nodiscard]] virtual DriverDetails GetDetails() const
    {
        return {};
    }

    /// The instant actions that operators may request; owned by the robot, always the same. The default has none.
    [[nodiscard]] virtual IRobotActions* GetActionsOrNull() noexcept
    {
        return nullptr;
    }
};

} // namespace ACS::Acsd
