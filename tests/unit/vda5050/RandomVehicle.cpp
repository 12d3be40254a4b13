#include "RandomVehicle.hpp"

#include "Vda5050Sample.hpp"
#include <acs/core/Overloaded.hpp>

#include <algorithm>
#include <iterator>
#include <utility>

namespace ACS::VDA5050::Test
{

VehicleOptions RandomVehicle::MakeOptions(bool bStopsBetweenNodes)
{
    VehicleOptions options;
    options.address = MakeAddress();
    options.initialNodeID = "start";
    options.minimumStateInterval = MINIMUM;
    options.bStopsBetweenNodes = bStopsBetweenNodes;
    return options;
}

RandomVehicle::RandomVehicle(std::uint64_t seed)
    : _random(seed),
      _session(MakeOptions(seed % 2 == 0))
{
    _session.OnLinkUp(_clock.GetNow(), _out);
    Execute();
}

const Testing::StateSequenceChecker& RandomVehicle::GetChecker() const
{
    return _checker;
}

std::uint32_t RandomVehicle::Choose(std::uint32_t count)
{
    return static_cast<std::uint32_t>(_random.GetNext() % count);
}

std::string RandomVehicle::MakeID(std::string_view prefix)
{
    return std::string(prefix) + std::to_string(_nextID++);
}

void RandomVehicle::After(std::uint32_t maximumMilliseconds, Event event)
{
    const std::chrono::milliseconds delay(Choose(maximumMilliseconds + 1));
    _events.emplace(_clock.GetNow().steady + delay, std::move(event));
}

void RandomVehicle::Step()
{
    if (Choose(6) == 0)
    {
        ActAsMaster();
    }
    else if (!TryPassTime(Choose(2) == 0))
    {
        _checker.CheckComplete(_session.GetState());
        ActAsMaster();
    }
}

void RandomVehicle::Finish()
{
    constexpr int MAXIMUM_STEPS = 1000;
    _session.OnHardwarePause(false, false, _clock.GetNow(), _out);
    Execute();
    SendInstantAction(ActionTypes::STOP_PAUSE);
    for (int step = 0; step < MAXIMUM_STEPS; ++step)
    {
        if (TryPassTime(true))
        {
            continue;
        }
        if (!_session.IsOrderRunning())
        {
            break;
        }
        SendInstantAction(ActionTypes::CANCEL_ORDER); // the end of a base with a horizon
    }
    _checker.CheckComplete(_session.GetState());
    _checker.CheckEnded();
}

bool RandomVehicle::TryPassTime(bool bSkip)
{
    constexpr std::uint32_t MAXIMUM_PAUSE = 20;
    const auto timer = _timers.find(EVehicleTimer::MinimumStateInterval);
    std::optional<Core::SteadyTime> next;
    if (!_events.empty())
    {
        next = _events.begin()->first;
    }
    const bool bTimer = timer != _timers.end() && (!next.has_value() || timer->second < *next);
    next = bTimer ? timer->second : next;
    if (!next.has_value())
    {
        return false;
    }
    const auto wait =
        std::chrono::ceil<std::chrono::milliseconds>(std::max(*next - _clock.GetNow().steady, Core::Duration::zero()));
    const std::chrono::milliseconds pause(Choose(MAXIMUM_PAUSE));
    if (!bSkip && pause < wait)
    {
        _clock.Advance(pause);
        return true;
    }
    _clock.Advance(wait);
    if (bTimer)
    {
        _timers.erase(timer);
        _session.OnTimer(EVehicleTimer::MinimumStateInterval, _clock.GetNow(), _out);
    }
    else
    {
        const Event event = std::move(_events.extract(_events.begin()).mapped());
        event();
    }
    Execute();
    return true;
}

void RandomVehicle::Execute()
{
    while (!_out.empty())
    {
        for (const VehicleAction& action : std::exchange(_out, {}))
        {
            std::visit(
                Core::Overloaded{
                    [this](const PublishMessage& publish) { Check(publish.message); },
                    [this](const StartVehicleTimer& start) {
                        _timers[start.timer] = _clock.GetNow().steady + start.delay;
                    },
                    [this](const CancelVehicleTimer& cancel) { _timers.erase(cancel.timer); },
                    [this](const DriveTo& drive) { Perform(drive); },
                    [this](const StopDriving&) { Stop(); },
                    [this](const StartAction& start) { Perform(start); },
                    [this](const StopAction& stop) { Perform(stop); },
                    [this](const PauseAction& pause) {
                        if (Choose(2) == 0)
                        {
                            SetStatus(pause.actionID, EActionStatus::Paused);
                        }
                    },
                    [this](const ResumeAction& resume) {
                        SetStatus(resume.actionID, EActionStatus::Running);
                        After(100, [this, actionID = resume.actionID] {
                            SetStatus(actionID, EActionStatus::Finished);
                        });
                    },
                    [](const auto& /*event*/) {
                    }},
                action);
        }
    }
}

void RandomVehicle::Check(const MqttMessage& message)
{
    if (message.topic == BuildTopic(MakeAddress(), ETopic::State))
    {
        _checker.Check(_codec.Decode<StateMessage>(message.payload).value(), _clock.GetNow().steady);
    }
}

void RandomVehicle::Perform(const StopAction& stop)
{
    if (stop.bEdgeEnded)
    {
        _running.erase(stop.actionID);
    }
    else if (Choose(2) == 0) // otherwise it cannot be interrupted
    {
        After(60, [this, actionID = stop.actionID] { SetStatus(actionID, EActionStatus::Failed); });
    }
}

void RandomVehicle::Perform(const DriveTo& drive)
{
    const bool bSameLeg = _leg.has_value() && _leg->node.sequenceID == drive.node.sequenceID;
    _leg = drive;
    if (bSameLeg)
    {
        return;
    }
    const std::uint64_t started = ++_drive;
    _session.OnDrivingChanged(true, _clock.GetNow(), _out);
    After(200, [this, started] {
        if (started == _drive)
        {
            Arrive();
        }
    });
}

void RandomVehicle::Arrive()
{
    const DriveTo leg = *std::exchange(_leg, std::nullopt);
    ++_drive;
    NodeArrival arrival{leg.node.sequenceID, leg.bStopAtNode};
    for (const Action& action : leg.edge.actions)
    {
        if (_running.contains(action.actionID) && Choose(2) == 0)
        {
            const EActionStatus status = Choose(2) == 0 ? EActionStatus::Finished : EActionStatus::Failed;
            arrival.edgeActions.push_back({action.actionID, status});
        }
    }
    static_cast<void>(_session.TryReachNode(std::move(arrival), _clock.GetNow(), _out));
}

/// Brakes, and may pass a node at which it need not stop.
void RandomVehicle::Stop()
{
    const std::optional<DriveTo> leg = std::exchange(_leg, std::nullopt);
    const std::uint64_t stopped = ++_drive;
    const bool bPasses = leg.has_value() && !leg->bStopAtNode && Choose(3) == 0;
    After(100, [this, stopped, leg, bPasses] {
        if (stopped != _drive)
        {
            return; // it drives again
        }
        if (bPasses)
        {
            static_cast<void>(_session.TryReachNode({leg->node.sequenceID}, _clock.GetNow(), _out));
        }
        After(30, [this, stopped] {
            if (stopped == _drive)
            {
                _session.OnDrivingChanged(false, _clock.GetNow(), _out);
            }
        });
    });
}

void RandomVehicle::Perform(const StartAction& start)
{
    _running.emplace(start.action.actionID, start);
    const std::string actionID = start.action.actionID;
    After(30, [this, actionID] {
        SetStatus(actionID, EActionStatus::Running);
        const EActionStatus status = Choose(4) == 0 ? EActionStatus::Failed : EActionStatus::Finished;
        After(150, [this, actionID, status] { SetStatus(actionID, status); });
    });
}

void RandomVehicle::SetStatus(const std::string& actionID, EActionStatus status)
{
    // A paused action ends after it was resumed, one that the session has ended not at all.
    if (_session.TrySetActionStatus(actionID, status, {}, _clock.GetNow(), _out) && IsTerminal(status))
    {
        _running.erase(actionID);
    }
}

void RandomVehicle::ActAsMaster()
{
    switch (Choose(9))
    {
        case 0:
            SendInstantAction(ActionTypes::CANCEL_ORDER);
            break;
        case 1:
            SendInstantAction(ActionTypes::START_PAUSE);
            break;
        case 2:
        case 3:
            SendInstantAction(ActionTypes::STOP_PAUSE);
            break;
        case 4:
            SendInstantAction(ActionTypes::STATE_REQUEST);
            break;
        case 5:
            _session.OnHardwarePause(Choose(2) == 0, false, _clock.GetNow(), _out);
            Execute();
            break;
        case 6:
            _session.OnLinkDown(_clock.GetNow(), _out);
            Execute();
            _clock.Advance(std::chrono::milliseconds(Choose(30)));
            _session.OnLinkUp(_clock.GetNow(), _out);
            Execute();
            break;
        default:
            SendOrder();
            break;
    }
}

void RandomVehicle::SendOrder()
{
    constexpr std::uint32_t MAXIMUM_NODES = 5;
    if (_session.IsOrderRunning())
    {
        if (_order.has_value() && !_order->IsWholeRouteReleased())
        {
            const auto left = static_cast<std::uint32_t>(_order->GetNodes().size() - _order->GetReleasedNodes());
            Send(*_order->MakeUpdate(_order->GetReleasedNodes() + 1 + Choose(left)));
        }
        return;
    }
    const std::uint32_t count = 1 + Choose(MAXIMUM_NODES);
    std::vector<OrderNode> nodes(count);
    std::vector<OrderEdge> edges(count - 1);
    for (OrderNode& node : nodes)
    {
        node.nodeID = MakeID("node-");
        AddActions(node.actions, "n");
    }
    nodes.front().nodeID = _session.GetState().lastNodeID;
    for (OrderEdge& edge : edges)
    {
        edge.edgeID = MakeID("edge-");
        AddActions(edge.actions, "e");
    }
    _order = *OrderBuilder::Create(MakeID("order-"), std::move(nodes), std::move(edges));
    Send(*_order->MakeOrder(1 + Choose(count)));
}

void RandomVehicle::AddActions(std::vector<Action>& actions, std::string_view prefix)
{
    const std::uint32_t count = Choose(3);
    for (std::uint32_t index = 0; index < count; ++index)
    {
        actions.push_back(MakeAction(MakeID(prefix), static_cast<EBlockingType>(Choose(3))));
    }
}

void RandomVehicle::Send(OrderMessage order)
{
    order.header = Header{_headerID++, _clock.GetNow().wall, "2.0.0", "ACS", "LR01"};
    const std::string payload = _codec.Encode(order, EVda5050Version::Version200);
    _session.OnMessage(BuildTopic(MakeAddress(), ETopic::Order), payload, false, _clock.GetNow(), _out);
    const bool bTaken = std::ranges::any_of(_out, [](const VehicleAction& action) {
        return std::holds_alternative<OrderTaken>(action);
    });
    if (bTaken)
    {
        _checker.AddOrder(order);
    }
    Execute();
}

void RandomVehicle::SendInstantAction(std::string_view actionType)
{
    const std::string actionID = MakeID("i");
    InstantActionsMessage message;
    message.header = Header{_headerID++, _clock.GetNow().wall, "2.0.0", "ACS", "LR01"};
    message.actions.push_back(MakeAction(actionID, EBlockingType::Hard, std::string(actionType)));
    const bool bNodesLeft = !_session.GetState().nodeStates.empty();
    _checker.AddInstantAction(actionID);
    if (actionType == ActionTypes::CANCEL_ORDER && bNodesLeft)
    {
        _checker.AddCancel(actionID);
    }
    const std::string payload = _codec.Encode(message, EVda5050Version::Version200);
    _session.OnMessage(BuildTopic(MakeAddress(), ETopic::InstantActions), payload, false, _clock.GetNow(), _out);
    Execute();
}

} // namespace ACS::VDA5050::Test
