#include "robots/VehicleRobot.hpp"

#include "robots/InstantActionCheck.hpp"
#include "robots/VehicleDetails.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/vda5050/MasterSession.hpp>

#include <chrono>
#include <utility>
#include <variant>

namespace ACS::Acsd
{

namespace
{

constexpr const char* ROBOT_SEEN = "acsd_robot_last_seen_seconds";
constexpr const char* ROBOT_STATES = "acsd_robot_states_received_total";
constexpr const char* ROBOT_RESENT = "acsd_robot_orders_resent_total";
constexpr const char* ARM_UP = "acsd_arm_up";
constexpr const char* ARM_CONNECTS = "acsd_arm_connects_total";
constexpr const char* ARM_MISSING = "acsd_arm_samples_missing_total";

constexpr const char* COMPONENT = "robot"; ///< In the log, of all vehicles.

} // namespace

VehicleRobot::VehicleRobot(RobotServices services, std::shared_ptr<const VehicleConfig> config)
    : _services(std::move(services)),
      _config(std::move(config)),
      _made(MakeRobotAdapter(*_config, _outputs)),
      _watch(
          *_config->site,
          _config->robotID,
          {_services.clock, _services.logger.MakeFor(COMPONENT), _services.metrics},
          _config->methods.GetPositions(),
          _config->protocolVersion),
      _retained(
          {*_services.mqttOrNull, _services.logger.MakeFor(COMPONENT), _services.metrics},
          _config->robotID,
          _config->address),
      _unsent(_services.logger.MakeFor(COMPONENT)),
      _timers(
          _services.executor,
          [this](ETimer) {
              _retained.Renew();
              StartRenewal();
          }),
      _arm(MakeArmOrNull())
{
    IRobotMetrics& metrics = _services.metrics;
    metrics.AddGauge(ROBOT_SEEN, "Seconds since the last message of the vehicle; absent until the first");
    metrics.AddCounter(ROBOT_STATES, "VDA5050 states received");
    metrics.AddCounter(ROBOT_RESENT, "VDA5050 orders that were sent again");
    metrics.AddGauge(ARM_UP, "1 when the arm's Open Stream session is ready");
    metrics.AddCounter(ARM_CONNECTS, "Open Stream sessions that began");
    metrics.AddCounter(ARM_MISSING, "MONITOR samples that did not arrive");
}

Planning::IRobotAdapter& VehicleRobot::GetAdapter() noexcept
{
    return *_made.adapter;
}

void VehicleRobot::Start()
{
    _services.mqttOrNull->SetListener(this);
    _services.mqttOrNull->Subscribe(_made.adapter->GetSubscriptions());
    if (_arm != nullptr)
    {
        _arm->Start();
    }
}

void VehicleRobot::Stop()
{
    _timers.CancelAll();
    if (_arm != nullptr)
    {
        _arm->Stop();
    }
}

void VehicleRobot::OnAdapterCalled()
{
    for (const VDA5050::MqttMessage& message : std::exchange(_outputs.messages, {}))
    {
        Publish(message);
    }
    for (const ArmRequest& request : std::exchange(_outputs.armRequests, {}))
    {
        Send(request);
    }
}

void VehicleRobot::UpdateMetrics()
{
    IRobotMetrics& metrics = _services.metrics;
    if (_seenAt.has_value())
    {
        const std::chrono::duration<double> age = _services.clock.GetNow().steady - *_seenAt;
        metrics.SetGauge(ROBOT_SEEN, age.count());
    }
    const VDA5050::MasterStatistics& vehicle = _made.adapter->GetSession().GetStatistics();
    metrics.SetTotal(ROBOT_STATES, static_cast<double>(vehicle.statesReceived));
    metrics.SetTotal(ROBOT_RESENT, static_cast<double>(vehicle.ordersResent));
    if (_arm != nullptr)
    {
        const OpenStream::ClientSessionStats& arm = _arm->GetStats();
        metrics.SetGauge(ARM_UP, _arm->GetState() == OpenStream::EClientState::Ready ? 1.0 : 0.0);
        metrics.SetTotal(ARM_CONNECTS, static_cast<double>(arm.connects));
        metrics.SetTotal(ARM_MISSING, static_cast<double>(arm.missingLines));
    }
}

DriverDetails VehicleRobot::GetDetails() const
{
    DriverDetails details;
    details.warnings = _watch.ListWarnings();
    if (const VDA5050::StateMessage* const stateOrNull = _made.adapter->GetSession().GetStateOrNull())
    {
        AddStateDetails(*stateOrNull, details);
    }
    details.lastMessageAt = _seenWallAt;
    if (_arm != nullptr)
    {
        details.bArmUp = _arm->GetState() == OpenStream::EClientState::Ready;
    }
    return details;
}

IRobotActions* VehicleRobot::GetActionsOrNull() noexcept
{
    return this;
}

std::vector<RobotActionOffer> VehicleRobot::ListOffers() const
{
    const VDA5050::MasterSession& session = _made.adapter->GetSession();
    const InstantActionCheck check(_config->methods, session.GetOptions().version);
    return check.ListOffers(session.GetFactsheetOrNull());
}

tl::expected<std::string, RobotActionRefusal> VehicleRobot::Request(
    const RobotActionRequest& request,
    Core::Now now,
    Planning::AdapterActions& out)
{
    return _made.adapter->RequestAction(request, now, out);
}

std::vector<RobotActionChange> VehicleRobot::TakeChanges()
{
    return std::exchange(_outputs.actionChanges, {});
}

std::unique_ptr<OpenStreamAsio::OpenStreamClient> VehicleRobot::MakeArmOrNull()
{
    if (!_config->armOrNull.has_value())
    {
        return nullptr;
    }
    OpenStreamAsio::OpenStreamClientOptions options;
    options.host = _config->armOrNull->peer.host;
    options.port = _config->armOrNull->peer.port;
    options.session = MakeArmSessionOptions();
    return _services.openStream.MakeClient(
        std::move(options),
        [this](const OpenStream::ClientEvent& event, Core::Now /*now*/) { OnArmEvent(event); });
}

void VehicleRobot::OnArmEvent(const OpenStream::ClientEvent& event)
{
    _watch.OnArmEvent(event);
    _services.call(
        [this, &event](Core::Now now, Planning::AdapterActions& out) { _made.armOrNull->OnArmEvent(event, now, out); });
}

void VehicleRobot::Publish(const VDA5050::MqttMessage& message)
{
    const Core::Result<void> published = _services.mqttOrNull->Publish(message);
    if (!published)
    {
        // The session sends it again until the vehicle's state shows it.
        _unsent.Write(
            _services.clock.GetNow().steady,
            Core::ELogLevel::Warning,
            "unsent",
            "a message to the vehicle could not be sent",
            {{"robotId", _config->robotID}, {"topic", message.topic}, {"reason", Core::Describe(published.error())}});
    }
}

void VehicleRobot::Send(const ArmRequest& request) const
{
    std::visit(
        Core::Overloaded{
            [this](const OpenStream::MonitorRequest& monitor) { _arm->SetMonitor(monitor); },
            [this](const OpenStream::ControlRequest& control) {
                static_cast<void>(_arm->SendControl(control));
            }},
        request);
}

void VehicleRobot::StartRenewal()
{
    _timers.Start(ETimer::Renewal, RetainedCommands::RENEWAL);
}

void VehicleRobot::OnLinkUp()
{
    _retained.OnLinkUp();
    StartRenewal();
    _services.call([this](Core::Now now, Planning::AdapterActions& out) { _made.adapter->OnLinkUp(now, out); });
}

void VehicleRobot::OnLinkDown(std::error_code /*reason*/)
{
    _retained.OnLinkDown();
    _timers.CancelAll();
    _services.call([this](Core::Now now, Planning::AdapterActions& out) { _made.adapter->OnLinkDown(now, out); });
}

void VehicleRobot::OnMqttMessage(const VDA5050::MqttMessage& message)
{
    if (_retained.TryHandle(message))
    {
        return;
    }
    if (!message.bRetained)
    {
        const Core::Now now = _services.clock.GetNow();
        _seenAt = now.steady;
        _seenWallAt = now.wall;
    }
    const VDA5050::MasterSession& session = _made.adapter->GetSession();
    const std::uint64_t statesBefore = session.GetStatistics().statesReceived;
    _services.call([this, &message](Core::Now now, Planning::AdapterActions& out) {
        _made.adapter->OnMqttMessage(message, now, out);
    });
    _watch.OnStatistics(session.GetStatistics());
    if (message.topic.ends_with("/factsheet") && session.GetFactsheetOrNull() != nullptr)
    {
        _watch.OnFactsheet(*session.GetFactsheetOrNull());
    }
    if (session.GetStatistics().statesReceived != statesBefore)
    {
        _watch.OnState(*session.GetStateOrNull());
    }
    else if (session.GetLink() != VDA5050::EVehicleLink::Online)
    {
        _watch.OnAway();
    }
}

} // namespace ACS::Acsd
