#pragma once

#include "common/http/MetricsEndpoint.hpp"
#include "common/log/LogRateLimiter.hpp"
#include "common/process/TimerSet.hpp"
#include "config/AcsdConfig.hpp"
#include "drivers/ActionHistory.hpp"
#include "drivers/DriverMetrics.hpp"
#include "drivers/MqttRouter.hpp"
#include "drivers/OpenStreamService.hpp"
#include "trace/MessageTrace.hpp"
#include <acs/acsd/IRobot.hpp>
#include <acs/acsd/RobotServices.hpp>
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/plan/RobotCommand.hpp>
#include <acs/plan/RobotEvent.hpp>

#include <boost/asio/any_io_executor.hpp>
#include <tl/expected.hpp>

#include <deque>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// Runs one robot by its driver: passes commands and timers to its adapter, and its events to the engine. Decides nothing. Runs on
/// one thread, the executor's.
class RobotRunner final
{
public:
    /// Called from within the calls of the host and from the robot; may call Handle.
    using EventHandler = std::function<void(const std::string& robotID, const Planning::RobotEvent& event)>;

    /// Called when an operator has requested an instant action, and when one has ended.
    using ActionHandler = std::function<void(const std::string& robotID, const RobotActionRecord& record)>;

    /// All of these must outlive it.
    struct Dependencies
    {
        boost::asio::any_io_executor executor;
        Core::IClock& clock;
        Core::IRandom& random;
        Core::Logger logger;
        Apps::MetricsEndpoint& metrics;
        MessageTrace* traceOrNull = nullptr;
        MqttRouter* mqttOrNull = nullptr;   ///< Set if a robot has a topic prefix.
        ActionHandler onAction{};           ///< May be empty.
        std::function<bool()> mayCommand{}; ///< Asked before each message to an arm; empty: it may be sent.
    };

private:
    Dependencies _dependencies;
    const std::string _robotID;
    const std::string _driver;
    const std::vector<std::string> _ports;
    EventHandler _handler;
    DriverMetrics _metrics;
    const std::unique_ptr<IMqttService> _mqtt; ///< Null if the robot does not use the broker.
    OpenStreamService _openStream;
    std::unique_ptr<IRobot> _robot;
    std::deque<Planning::AdapterAction> _actions; ///< Not executed yet.
    bool _bExecuting = false;
    bool _bStopped = false;
    Apps::LogRateLimiter _ignored; ///< A robot may send a bad value with each state.
    Apps::TimerSet<Planning::AdapterTimerID> _timers;
    ActionHistory _history;

public:
    /// Makes the robot by its setup, which is set.
    RobotRunner(Dependencies dependencies, const RobotLinkConfig& link, EventHandler handler);
    RobotRunner(const RobotRunner&) = delete;
    RobotRunner& operator=(const RobotRunner&) = delete;
    ~RobotRunner() = default;

    void Start();
    void Stop();
    /// Possible before Start: the engine asks for jobs from before a restart as soon as they are restored.
    void Handle(const Planning::RobotCommand& command);
    void UpdateMetrics();
    [[nodiscard]] DriverDetails GetDetails() const;

    /// Has the robot validate and send an instant action of an operator. The result is its id. Not after Stop.
    [[nodiscard]] tl::expected<std::string, RobotActionRefusal> RequestAction(
        RobotActionRequest request,
        std::string reason);
    /// The last instant actions, oldest first.
    [[nodiscard]] const std::vector<RobotActionRecord>& GetActions() const noexcept;
    /// Those that RequestAction accepts at present; none after Stop.
    [[nodiscard]] std::vector<RobotActionOffer> ListActionOffers() const;

private:
    [[nodiscard]] RobotServices MakeServices();
    /// Calls the adapter and executes its actions. An event may lead to another call of the adapter: its actions are executed
    /// after the rest of these, which may for instance cancel a timer that the new call starts.
    template <typename TCall>
    void Call(const TCall& adapterCall);
    template <typename TCall>
    void CallAdapter(const TCall& adapterCall, Planning::AdapterActions& out) const;
    void Execute(const Planning::AdapterAction& action);
    void UpdateHistory();
    void PublishAction(const RobotActionRecord& record) const;
    void LogDefects(const Planning::RobotEvent& event);
    void Trace(ETraceDirection direction, std::string_view text) const;
};

} // namespace ACS::Acsd
