#include "FleetMaster.hpp"

#include "RingSite.hpp"
#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>
#include <variant>

namespace ACS::Load
{
namespace
{

constexpr std::size_t ORDER_EDGES = 60;
constexpr std::size_t BASE_NODES = 10;  ///< Of the first message of an order.
constexpr std::size_t RELEASE_AT = 4;   ///< When at most this number of released nodes is ahead,
constexpr std::size_t RELEASE_MORE = 8; ///< this number of nodes is released.
constexpr std::uint64_t TIMERS = 16;    ///< A vehicle has fewer.

VDA5050::FleetOptions MakeFleetOptions()
{
    VDA5050::FleetOptions options;
    options.vehicle.address.interfaceName = "uagv";
    return options;
}

VDA5050::MosquittoOptions MakeLinkOptions(std::uint16_t port)
{
    VDA5050::MosquittoOptions options;
    options.port = port;
    options.clientID = "load-master";
    return options;
}

/// Without a parser, so that the measurement costs little compared with what it measures.
std::optional<std::uint32_t> FindHeaderIDOrNull(std::string_view payload)
{
    constexpr std::string_view KEY = "\"headerId\":";
    const std::size_t found = payload.find(KEY);
    std::uint32_t headerID = 0;
    if (found == std::string_view::npos)
    {
        return std::nullopt;
    }
    const char* const begin = payload.data() + found + KEY.size();
    const auto [end, error] = std::from_chars(begin, payload.data() + payload.size(), headerID);
    return error == std::errc() ? std::optional(headerID) : std::nullopt;
}

void Count(TopicCount& count, std::string_view payload, Core::SteadyTime now)
{
    const std::optional<std::uint32_t> headerID = FindHeaderIDOrNull(payload);
    if (headerID.has_value() && count.lastHeaderID.has_value() && *headerID > *count.lastHeaderID)
    {
        count.missing += *headerID - *count.lastHeaderID - 1;
    }
    if (count.lastTime.has_value())
    {
        count.longestPause = std::max(count.longestPause, now - *count.lastTime);
    }
    ++count.messages;
    count.lastHeaderID = headerID;
    count.lastTime = now;
}

void Forget(TopicCount& count)
{
    count.messages = 0;
    count.missing = 0;
    count.longestPause = {};
}

} // namespace

FleetMaster::FleetMaster(boost::asio::io_context& context, std::uint16_t port)
    : _fleet(MakeFleetOptions()),
      _link(context.get_executor(), _random, Core::Logger(), MakeLinkOptions(port), *this),
      _timers(context.get_executor(), [this](std::uint64_t key) { OnTimer(key); })
{
    _link.Subscribe(_fleet.GetSubscriptions());
    _link.Start();
}

void FleetMaster::OnLinkUp()
{
    _fleet.OnLinkUp(_clock.GetNow(), _actions);
    Execute();
}

void FleetMaster::OnLinkDown(std::error_code reason)
{
    CountError(0, "the link is down: " + reason.message());
    _fleet.OnLinkDown(_clock.GetNow(), _actions);
    Execute();
}

void FleetMaster::OnMqttMessage(const VDA5050::MqttMessage& message)
{
    const Core::Now now = _clock.GetNow();
    _fleet.OnMessage(message, now, _actions);
    _counts.resize(_fleet.GetSize());
    _jobs.resize(_fleet.GetSize());
    const Core::Result<VDA5050::ParsedTopic> name = VDA5050::ParseTopic(message.topic);
    const std::optional<std::size_t> vehicle =
        name.has_value() ? _fleet.FindOrNull(name->address) : std::optional<std::size_t>();
    if (vehicle.has_value() && name->topic == VDA5050::ETopic::State)
    {
        Count(_counts[*vehicle].states, message.payload, now.steady);
    }
    else if (vehicle.has_value() && name->topic == VDA5050::ETopic::Visualization)
    {
        Count(_counts[*vehicle].visualizations, message.payload, now.steady);
    }
    Execute();
}

void FleetMaster::ResetCounts()
{
    for (VehicleCount& count : _counts)
    {
        Forget(count.states);
        Forget(count.visualizations);
    }
    _total = {};
}

const std::vector<VehicleCount>& FleetMaster::GetCounts() const noexcept
{
    return _counts;
}

const MasterCount& FleetMaster::GetTotal() const noexcept
{
    return _total;
}

std::size_t FleetMaster::CountDriving() const
{
    std::size_t count = 0;
    for (std::size_t vehicle = 0; vehicle < _fleet.GetSize(); ++vehicle)
    {
        const VDA5050::MasterSession& session = _fleet.GetSession(vehicle);
        const VDA5050::StateMessage* const state = session.GetStateOrNull();
        const bool bDrives = state != nullptr && state->bDriving;
        count += bDrives && session.IsReady() && session.GetOrderPhase() == VDA5050::EOrderPhase::Active ? 1U : 0U;
    }
    return count;
}

void FleetMaster::OnTimer(std::uint64_t key)
{
    _fleet.OnTimer(key / TIMERS, static_cast<VDA5050::EMasterTimer>(key % TIMERS), _clock.GetNow(), _actions);
    Execute();
}

void FleetMaster::Execute()
{
    while (!_actions.empty())
    {
        for (const VDA5050::FleetAction& action : std::exchange(_actions, {}))
        {
            Handle(action.vehicle, action.action);
        }
    }
}

void FleetMaster::Handle(std::size_t vehicle, const VDA5050::MasterAction& action)
{
    const auto getKey = [vehicle](VDA5050::EMasterTimer timer) {
        return vehicle * TIMERS + static_cast<std::uint64_t>(timer);
    };
    std::visit(
        Core::Overloaded{
            [this, vehicle](const VDA5050::PublishMessage& publish) {
                if (!_link.Publish(publish.message).has_value())
                {
                    CountError(vehicle, "cannot send a message");
                }
            },
            [this, getKey](const VDA5050::StartMasterTimer& start) { _timers.Start(getKey(start.timer), start.delay); },
            [this, getKey](const VDA5050::CancelMasterTimer& cancel) { _timers.Cancel(getKey(cancel.timer)); },
            [this, vehicle](const VDA5050::StateReceived&) {
                if (_fleet.GetSession(vehicle).CanTakeOrder())
                {
                    SendNextOrder(vehicle);
                }
            },
            [this, vehicle](const VDA5050::NodeReached&) {
                ++_total.nodesReached;
                ++_jobs[vehicle].reachedNodes;
                ReleaseMore(vehicle);
            },
            [this, vehicle](const VDA5050::OrderRejected& rejected) {
                CountError(vehicle, "order rejected: " + rejected.errorType + " " + rejected.reason);
            },
            [this, vehicle](const VDA5050::OrderLost& lost) { CountError(vehicle, "order lost: " + lost.reason); },
            [this, vehicle](const VDA5050::VehicleSilent&) { CountError(vehicle, "silent"); },
            [this, vehicle](const VDA5050::VehicleBroken&) { CountError(vehicle, "its connection broke down"); },
            [this, vehicle](const VDA5050::MessageRefused& refused) {
                CountError(vehicle, "message refused: " + Core::Describe(refused.error));
            },
            [this, vehicle](const VDA5050::VehicleErrorChanged& changed) {
                if (changed.bActive)
                {
                    CountError(vehicle, "error " + changed.error.errorType);
                }
            },
            [](const auto& /*other*/) {
            }},
        action);
}

void FleetMaster::SendNextOrder(std::size_t vehicle)
{
    VDA5050::MasterSession& session = _fleet.GetSession(vehicle);
    Job& job = _jobs[vehicle];
    // The first orders differ in length, so that the next ones are not due all at once.
    const std::size_t edges = job.orders == 0 ? ORDER_EDGES - vehicle % (ORDER_EDGES / 2) : ORDER_EDGES;
    job.route = RingSite::MakeRoute(
        fmt::format("order-{}-{}", vehicle, ++job.orders),
        RingSite::GetNodeIndex(session.GetStateOrNull()->lastNodeID),
        edges);
    job.reachedNodes = 0;
    VDA5050::MasterActions actions;
    const auto order = job.route->MakeOrder(BASE_NODES);
    if (!order.has_value() || !session.SendOrder(*order, _clock.GetNow(), actions).has_value())
    {
        CountError(vehicle, "cannot send an order");
    }
    ++_total.ordersSent;
    VDA5050::AppendActions(vehicle, actions, _actions);
}

void FleetMaster::ReleaseMore(std::size_t vehicle)
{
    Job& job = _jobs[vehicle];
    if (!job.route.has_value() || job.route->IsWholeRouteReleased()
        || job.route->GetReleasedNodes() > job.reachedNodes + RELEASE_AT)
    {
        return;
    }
    const std::size_t released = std::min(job.route->GetReleasedNodes() + RELEASE_MORE, job.route->GetNodes().size());
    VDA5050::MasterActions actions;
    const auto update = job.route->MakeUpdate(released);
    if (!update.has_value()
        || !_fleet.GetSession(vehicle).SendOrderUpdate(*update, _clock.GetNow(), actions).has_value())
    {
        CountError(vehicle, "cannot send an update");
    }
    ++_total.updatesSent;
    VDA5050::AppendActions(vehicle, actions, _actions);
}

void FleetMaster::CountError(std::size_t vehicle, std::string_view what)
{
    if (_total.errors++ == 0)
    {
        _total.firstError = fmt::format("vehicle {}: {}", vehicle, what);
    }
}

} // namespace ACS::Load
