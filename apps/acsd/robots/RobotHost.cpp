#include "robots/RobotHost.hpp"

#include "common/log/LogRateLimiter.hpp"
#include "common/process/TimerSet.hpp"
#include "robots/RetainedCommands.hpp"
#include "robots/RobotAdapterFactory.hpp"
#include "robots/RobotOutputs.hpp"
#include "robots/VehicleWatch.hpp"
#include "trace/ArmTrace.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/openstream_asio/OpenStreamClient.hpp>

#include <algorithm>
#include <deque>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>
#include <variant>

namespace ACS::Acsd
{

namespace
{

/// Of the host itself, not of its adapter.
constexpr Planning::AdapterTimerID RENEWAL_TIMER = 1'000;

OpenStreamAsio::OpenStreamClientOptions MakeArmOptions(const Apps::Url& arm)
{
    OpenStreamAsio::OpenStreamClientOptions options;
    options.host = arm.peer.host;
    options.port = arm.peer.port;
    options.session = MakeArmSessionOptions();
    return options;
}

} // namespace

struct RobotHost::Impl
{
    Dependencies surroundings;
    RobotLinkConfig robot;
    EventHandler handler;
    RobotOutputs outputs;
    std::unique_ptr<IMqttRobotAdapter> adapter;
    OpenStreamRobotAdapter* armAdapterOrNull = nullptr;
    std::optional<Apps::TimerSet<Planning::AdapterTimerID>> timers;
    std::deque<Planning::AdapterAction> actions; ///< Not executed yet.
    bool bExecuting = false;
    std::optional<ArmTrace> armTrace;
    VehicleWatch watch;
    RetainedCommands retained;
    Apps::LogRateLimiter unsent; ///< A vehicle that reconnects has messages each time.
    std::optional<Core::SteadyTime> seenAt;
    std::unique_ptr<OpenStreamAsio::OpenStreamClient> armClient;

    Impl(Dependencies around, const AcsdConfig& config, const RobotLinkConfig& link, EventHandler eventHandler)
        : surroundings(std::move(around)),
          robot(link),
          handler(std::move(eventHandler)),
          watch(
              *config.site,
              link.robotID,
              {surroundings.clock, surroundings.logger.MakeFor("robot"), surroundings.metrics},
              link.methods.GetPositions(),
              link.protocolVersion),
          retained(
              {surroundings.mqtt, surroundings.logger.MakeFor("robot"), surroundings.metrics},
              link.robotID,
              {GetInterfaceName(config), link.manufacturer, link.serialNumber}),
          unsent(surroundings.logger)
    {
        RobotAdapter made = MakeRobotAdapter(config, robot, outputs);
        adapter = std::move(made.adapter);
        armAdapterOrNull = made.armOrNull;
        timers.emplace(surroundings.executor, [this](Planning::AdapterTimerID timer) {
            if (timer == RENEWAL_TIMER)
            {
                retained.Renew();
                timers->Start(RENEWAL_TIMER, RetainedCommands::RENEWAL);
                return;
            }
            Call([this, timer](Core::Now now, Planning::AdapterActions& out) { adapter->OnTimer(timer, now, out); });
        });
    }

    /// Calls the adapter and executes its actions. An event may lead to another call of the adapter: its actions are executed
    /// after the rest of these, which may for instance cancel a timer that the new call starts.
    template <typename TCall>
    void Call(TCall call)
    {
        Planning::AdapterActions wanted;
        call(surroundings.clock.GetNow(), wanted);
        std::ranges::move(wanted, std::back_inserter(actions));
        if (std::exchange(bExecuting, true))
        {
            return;
        }
        while (!actions.empty())
        {
            const Planning::AdapterAction action = std::move(actions.front());
            actions.pop_front();
            Execute(action);
        }
        bExecuting = false;
        SendAll();
    }

    void SendAll()
    {
        for (const VDA5050::MqttMessage& message : std::exchange(outputs.messages, {}))
        {
            Publish(message);
        }
        for (const ArmRequest& request : std::exchange(outputs.armRequests, {}))
        {
            Send(request);
        }
    }

    void Execute(const Planning::AdapterAction& action)
    {
        std::visit(
            Core::Overloaded{
                [&](const Planning::RaiseEvent& raise) { handler(robot.robotID, raise.event); },
                [&](const Planning::StartAdapterTimer& start) { timers->Start(start.timer, start.delay); },
                [&](const Planning::CancelAdapterTimer& cancel) {
                    timers->Cancel(cancel.timer);
                }},
            action);
    }

    void Publish(const VDA5050::MqttMessage& message)
    {
        const Core::Result<void> published = surroundings.mqtt.Publish(message);
        if (!published)
        {
            // The session sends it again until the vehicle's state shows it.
            unsent.Write(
                surroundings.clock.GetNow().steady,
                Core::ELogLevel::Warning,
                "unsent",
                "a message to the vehicle could not be sent",
                {{"robotId", robot.robotID}, {"topic", message.topic}, {"reason", Core::Describe(published.error())}});
        }
    }

    void Send(const ArmRequest& request) const
    {
        std::visit(
            Core::Overloaded{
                [&](const OpenStream::MonitorRequest& monitor) { armClient->SetMonitor(monitor); },
                [&](const OpenStream::ControlRequest& control) {
                    static_cast<void>(armClient->SendControl(control));
                }},
            request);
    }

    void StartArm()
    {
        OpenStreamAsio::OpenStreamClientOptions options = MakeArmOptions(*robot.armOrNull);
        if (surroundings.traceOrNull != nullptr)
        {
            armTrace.emplace(*surroundings.traceOrNull, robot.robotID);
            options.onReceived = [this](std::string_view bytes) {
                armTrace->OnReceived(bytes);
            };
            options.onSent = [this](std::string_view bytes) {
                armTrace->OnSent(bytes);
            };
        }
        armClient = std::make_unique<OpenStreamAsio::OpenStreamClient>(
            surroundings.executor,
            surroundings.clock,
            surroundings.random,
            surroundings.logger.MakeFor("arm." + robot.robotID),
            std::move(options),
            [this](const OpenStream::ClientEvent& event, Core::Now /*now*/) {
                if (armTrace.has_value() && std::holds_alternative<OpenStream::ClientLost>(event))
                {
                    armTrace->OnLost();
                }
                watch.OnArmEvent(event);
                Call([this, &event](Core::Now now, Planning::AdapterActions& out) {
                    armAdapterOrNull->OnArmEvent(event, now, out);
                });
            });
        armClient->Start();
    }
};

Planning::RejectedActions RobotHost::FindRejectedActions(
    const AcsdConfig& config,
    const RobotLinkConfig& robot,
    Planning::ERobotType type)
{
    RobotOutputs outputs; // stays empty
    const RobotAdapter made = MakeRobotAdapter(config, robot, outputs);
    return Planning::FindRejectedActions(*made.adapter, type, config.engine.actions);
}

RobotHost::RobotHost(
    Dependencies surroundings,
    const AcsdConfig& config,
    const RobotLinkConfig& robot,
    EventHandler handler)
    : _impl(std::make_unique<Impl>(std::move(surroundings), config, robot, std::move(handler)))
{
}

RobotHost::~RobotHost() = default;

void RobotHost::Start()
{
    _impl->surroundings.mqtt.SetListener(this);
    _impl->surroundings.mqtt.Subscribe(_impl->adapter->GetSubscriptions());
    if (_impl->robot.armOrNull.has_value())
    {
        _impl->StartArm();
    }
}

void RobotHost::Stop()
{
    _impl->surroundings.mqtt.SetListener(nullptr);
    _impl->timers->CancelAll();
    if (_impl->armClient != nullptr)
    {
        _impl->armClient->Stop();
    }
}

void RobotHost::Handle(const Planning::RobotCommand& command)
{
    _impl->Call(
        [this, &command](Core::Now now, Planning::AdapterActions& out) { _impl->adapter->Handle(command, now, out); });
}

void RobotHost::OnLinkUp()
{
    _impl->retained.OnLinkUp();
    _impl->timers->Start(RENEWAL_TIMER, RetainedCommands::RENEWAL);
    _impl->Call([this](Core::Now now, Planning::AdapterActions& out) { _impl->adapter->OnLinkUp(now, out); });
}

void RobotHost::OnLinkDown(std::error_code /*reason*/)
{
    _impl->retained.OnLinkDown();
    _impl->timers->Cancel(RENEWAL_TIMER);
    _impl->Call([this](Core::Now now, Planning::AdapterActions& out) { _impl->adapter->OnLinkDown(now, out); });
}

void RobotHost::OnMqttMessage(const VDA5050::MqttMessage& message)
{
    if (_impl->retained.TryHandle(message))
    {
        return;
    }
    if (!message.bRetained)
    {
        _impl->seenAt = _impl->surroundings.clock.GetNow().steady;
    }
    const VDA5050::MasterSession& session = _impl->adapter->GetSession();
    const std::uint64_t statesBefore = session.GetStatistics().statesReceived;
    _impl->Call([this, &message](Core::Now now, Planning::AdapterActions& out) {
        _impl->adapter->OnMqttMessage(message, now, out);
    });
    _impl->watch.OnStatistics(session.GetStatistics());
    if (message.topic.ends_with("/factsheet") && session.GetFactsheetOrNull() != nullptr)
    {
        _impl->watch.OnFactsheet(*session.GetFactsheetOrNull());
    }
    if (session.GetStatistics().statesReceived != statesBefore)
    {
        _impl->watch.OnState(*session.GetStateOrNull());
    }
    else if (session.GetLink() != VDA5050::EVehicleLink::Online)
    {
        _impl->watch.OnAway();
    }
}

RobotHost::Figures RobotHost::GetFigures() const
{
    Figures figures{_impl->seenAt, _impl->adapter->GetSession().GetStatistics(), {}, false};
    if (_impl->armClient != nullptr)
    {
        figures.arm = _impl->armClient->GetStats();
        figures.bArmReady = _impl->armClient->GetState() == OpenStream::EClientState::Ready;
    }
    return figures;
}

const std::string& RobotHost::GetTopicPrefix() const noexcept
{
    return _impl->robot.topicPrefix;
}

std::vector<std::string> RobotHost::GetWarnings() const
{
    return _impl->watch.ListWarnings();
}

const std::string& RobotHost::GetRobotID() const noexcept
{
    return _impl->robot.robotID;
}

} // namespace ACS::Acsd
