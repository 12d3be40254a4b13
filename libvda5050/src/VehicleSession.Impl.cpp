#include "VehicleSession.Impl.hpp"

#include "OrderCapability.hpp"
#include "StateBounds.hpp"
#include <acs/vda5050/EVda5050Error.hpp>

#include <chrono>
#include <tuple>
#include <utility>

namespace ACS::VDA5050
{

namespace
{

double ToSeconds(std::chrono::milliseconds interval)
{
    return std::chrono::duration<double>(interval).count();
}

} // namespace

VehicleSession::Impl::Impl(VehicleOptions options)
    : _options(std::move(options))
{
    // The factsheet states the actual timing of the vehicle.
    ProtocolTiming& timing = _options.factsheet.protocolLimits.timing;
    timing.minStateInterval = ToSeconds(_options.minimumStateInterval);
    timing.defaultStateInterval = ToSeconds(_options.maximumStateInterval);
    timing.visualizationInterval.reset();
    if (_options.visualizationInterval.count() > 0)
    {
        timing.visualizationInterval = ToSeconds(_options.visualizationInterval);
    }
    if (std::optional<std::vector<OptionalParameter>>& list = _options.factsheet.protocolFeatures.optionalParameters;
        !list.has_value())
    {
        list = ListOptionalParameters(); // the schema demands a list
    }
}

MqttWill VehicleSession::Impl::MakeWill(Core::Now now)
{
    return MqttWill{_topics.MakeConnection(EConnectionState::ConnectionBroken, now)};
}

void VehicleSession::Impl::OnLinkUp(Core::Now now, VehicleActions& out)
{
    _schedule.OnLinkUp();
    out.emplace_back(PublishMessage{_topics.MakeConnection(EConnectionState::Online, now)});
    PublishFactsheet(now, out);
    Settle(now, out);
    if (_options.visualizationInterval.count() > 0)
    {
        out.emplace_back(StartVehicleTimer{EVehicleTimer::Visualization, _options.visualizationInterval});
    }
}

void VehicleSession::Impl::OnLinkDown(Core::Now /*now*/, VehicleActions& out)
{
    _schedule.OnLinkDown(out);
}

void VehicleSession::Impl::Leave(Core::Now now, VehicleActions& out)
{
    if (_schedule.IsLinkUp())
    {
        out.emplace_back(PublishMessage{_topics.MakeConnection(EConnectionState::Offline, now)});
        OnLinkDown(now, out);
    }
}

void VehicleSession::Impl::OnMessage(
    std::string_view topic,
    std::string_view payload,
    bool bRetained,
    Core::Now now,
    VehicleActions& out)
{
    const std::optional<ETopic> recognized = _topics.RecognizeOrNull(topic);
    if (!recognized.has_value())
    {
        return;
    }
    if (bRetained || payload.empty())
    {
        // An order of yesterday, replayed by the broker to a vehicle that has restarted; or a master that removes it there.
        out.emplace_back(MessageIgnored{
            *recognized,
            Core::Error{
                make_error_code(EVda5050Error::InvalidOrder),
                {},
                "a message sent now",
                bRetained ? "a retained one" : "an empty one, which removes a retained one"}});
        return;
    }
    if (*recognized == ETopic::Order)
    {
        OnOrder(payload, out);
    }
    else
    {
        OnInstantActions(payload, now, out);
    }
    Settle(now, out);
}

void VehicleSession::Impl::OnTimer(EVehicleTimer timer, Core::Now now, VehicleActions& out)
{
    if (!_schedule.IsLinkUp())
    {
        return;
    }
    switch (timer)
    {
        case EVehicleTimer::MinimumStateInterval:
            _schedule.OnMinimumTimer();
            Settle(now, out);
            break;
        case EVehicleTimer::MaximumStateInterval:
            Settle(true, now, out);
            break;
        case EVehicleTimer::Visualization:
            if (std::optional<VisualizationMessage> message = _reports.MakeVisualizationOrNull())
            {
                _topics.Publish(ETopic::Visualization, *message, now, out);
            }
            out.emplace_back(StartVehicleTimer{EVehicleTimer::Visualization, _options.visualizationInterval});
            break;
        default:
            break;
    }
}

const VehicleTopics& VehicleSession::Impl::GetTopics() const noexcept
{
    return _topics;
}

OwnerReports& VehicleSession::Impl::GetReports() noexcept
{
    return _reports;
}

bool VehicleSession::Impl::IsOrderRunning() const noexcept
{
    return _order.IsRunning();
}

bool VehicleSession::Impl::IsPaused() const noexcept
{
    return _pause.IsPaused();
}

StateMessage VehicleSession::Impl::GetState() const
{
    StateMessage state;
    state.header.manufacturer = _options.address.manufacturer;
    state.header.serialNumber = _options.address.serialNumber;
    _order.Fill(state);
    _reports.Fill(state);
    _errors.AppendTo(state.errors);
    // 6.6.3: a cancelled vehicle on its way to the next node shows that node alone, once the edge's actions have ended.
    const bool bEdgesShown = !_drive.IsOnLastLeg() || _actions.HasOpenOnEdge(_drive.GetRoute().GetEdgeSequenceID(0));
    _drive.Fill(state, bEdgesShown);
    _actions.Fill(state);
    state.bPaused = IsPaused() && _drive.IsStationary();
    state.bNewBaseRequest = _drive.NeedsNewBase(_options.lowBaseNodes) && !_order.IsCancelling();
    FitState(state, _options.factsheet.protocolLimits.maxArrayLengths);
    return state;
}

void VehicleSession::Impl::PublishState(Core::Now now, VehicleActions& out)
{
    StateMessage state = GetState();
    _topics.Publish(ETopic::State, state, now, out);
    _actions.MarkShown();
    _schedule.OnPublished(now, out);
    if (_errors.ShouldShowEnds())
    {
        _schedule.Request();
        std::ignore = _schedule.ShouldPublish(now, out); // not at once, but it starts the timer
    }
}

void VehicleSession::Impl::PublishFactsheet(Core::Now now, VehicleActions& out)
{
    if (_schedule.IsLinkUp())
    {
        _topics.Publish(ETopic::Factsheet, _options.factsheet, now, out);
    }
}

void VehicleSession::Impl::Settle(bool bChanged, Core::Now now, VehicleActions& out)
{
    if (bChanged)
    {
        _schedule.Request();
    }
    Settle(now, out);
}

void VehicleSession::Impl::Settle(Core::Now now, VehicleActions& out)
{
    if (_schedule.ShouldPublish(now, out))
    {
        PublishState(now, out);
    }
}

} // namespace ACS::VDA5050
