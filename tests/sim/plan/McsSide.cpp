#include "McsSide.hpp"

#include <acs/core/Overloaded.hpp>

#include <algorithm>
#include <optional>
#include <utility>
#include <variant>

namespace ACS::Simulation
{

using namespace std::chrono_literals;

namespace
{

constexpr std::uint64_t MCS_PART = 201;
constexpr std::uint64_t ID_DICE_PART = 202;

Protocol::AcsPayload MakeControl(Planning::EPlanControl control, const std::string& planID)
{
    using Planning::EPlanControl;
    switch (control)
    {
        case EPlanControl::Cancel:
            return Protocol::CancelPlan{planID, "requested by the simulation"};
        case EPlanControl::Abort:
            return Protocol::AbortPlan{planID, "requested by the simulation"};
        case EPlanControl::Pause:
            return Protocol::PausePlan{planID, "requested by the simulation"};
        case EPlanControl::Resume:
        default:
            return Protocol::ResumePlan{planID, {}};
    }
}

/// A copy of what may change during the loop or the call.
template <typename TValue>
TValue MakeCopy(const TValue& value)
{
    return value;
}

std::string GetPlanID(const Protocol::AcsPayload& payload)
{
    return std::visit(
        [](const auto& typed) -> std::string {
            if constexpr (requires {
                              typed.planID;
                              typed.reason;
                          })
            {
                return typed.planID;
            }
            else
            {
                return {};
            }
        },
        payload);
}

} // namespace

McsSide::McsSide(
    Timeline& timeline,
    Trace& trace,
    TextNetwork& network,
    McsJudge& judge,
    WorkChecker& workChecker,
    const Scenario& scenario)
    : _timeline(timeline),
      _trace(trace),
      _network(network),
      _judge(judge),
      _workChecker(workChecker),
      _scenario(scenario),
      _chance({scenario.seed, MCS_PART}),
      _idChance({scenario.seed, ID_DICE_PART}),
      _session(
          Protocol::McsSessionOptions{},
          McsSim::McsBehaviour{},
          _idChance,
          [this](std::chrono::milliseconds delay) {
              _delays.Start(EDelay::Ack, delay, [this] {
                  Run([this](Core::Now now, auto& out) { _session.SendDelayed(now, out); });
              });
          }),
      _sessionTimers(timeline),
      _delays(timeline),
      _behaviours(timeline)
{
    _network.Listen(*this);
}

void McsSide::Begin()
{
    SendPlan();
    if (_scenario.Has(EFault::Controls))
    {
        _behaviours.Start(EBehaviour::SendControl, _chance.GetBetween(0s, 20s), [this] { SendRandomControl(); });
    }
    if (_scenario.Has(EFault::Mcs))
    {
        _behaviours.Start(EBehaviour::Misbehave, _chance.GetBetween(0s, 40s), [this] { Misbehave(); });
    }
    _behaviours.Start(EBehaviour::Ask, _chance.GetBetween(10s, 90s), [this] { Ask(); });
}

void McsSide::BeginSettling()
{
    _bSettling = true;
    _session.EndFaults();
    _behaviours.CancelAll();
    while (_planIDs.size() < _scenario.planCount)
    {
        SendPlan();
    }
    _behaviours.Cancel(EBehaviour::SendPlan);
    // A report that has expired without an Ack is sent again only on the next connection.
    Run([this](Core::Now /*now*/, auto& out) { _session.Drop(Protocol::CLOSE_NORMAL, "once more", out); });
    Settle();
}

bool McsSide::IsSettled() const
{
    return _unanswered.empty();
}

template <typename TCall>
void McsSide::Run(TCall call)
{
    Protocol::SessionActions actions;
    call(_timeline.GetNow(), actions);
    std::ranges::move(actions, std::back_inserter(_actions));
    if (std::exchange(_bActing, true))
    {
        return;
    }
    while (!_actions.empty())
    {
        const Protocol::SessionAction action = std::move(_actions.front());
        _actions.pop_front();
        Act(action);
    }
    _bActing = false;
}

void McsSide::Act(const Protocol::SessionAction& action)
{
    std::visit(
        Core::Overloaded{
            [this](const Protocol::SendText& send) { _network.Send(send.connection, ETextEnd::Server, send.text); },
            [](const Protocol::Connect&) { /* of the other side */ },
            [this](const Protocol::Close& close) { _network.Close(close.connection, ETextEnd::Server, close.reason); },
            [this](const Protocol::StartTimer& start) {
                const Protocol::ESessionTimer timer = start.timer;
                _sessionTimers.Start(timer, start.delay, [this, timer] {
                    Run([this, timer](Core::Now now, auto& out) { _session.OnTimer(timer, now, out); });
                });
            },
            [this](const Protocol::CancelTimer& cancel) { _sessionTimers.Cancel(cancel.timer); },
            [this](const Protocol::Deliver& deliver) {
                Take(deliver.event);
            }},
        action);
}

void McsSide::OnOpened(Protocol::ConnectionID connection)
{
    Run([this, connection](Core::Now now, auto& out) { _session.OnConnected(connection, now, out); });
}

void McsSide::OnText(Protocol::ConnectionID connection, const std::string& text)
{
    Run([this, connection, &text](Core::Now now, auto& out) { _session.OnText(connection, text, now, out); });
}

void McsSide::OnClosed(Protocol::ConnectionID connection, const std::string& reason)
{
    Run([this, connection, &reason](Core::Now now, auto& out) { _session.OnClosed(connection, reason, now, out); });
}

void McsSide::Take(const Protocol::SessionEvent& event)
{
    std::visit(
        Core::Overloaded{
            [this](const Protocol::Registered&) {
                _trace.Add("MCS: registered");
                for (const auto& [transactionID, request] : MakeCopy(_unanswered))
                {
                    Send(request);
                }
            },
            [this](const Protocol::RequestReceived& received) { _judge.OnRequest(received.request); },
            [this](const Protocol::AckReceived& received) { OnAck(received.ack); },
            [this](const Protocol::RequestUnanswered& unanswered) { OnUnanswered(unanswered.transactionID); },
            [](const auto&) {
            }},
        event);
}

void McsSide::Send(const Protocol::AcsRequest& request)
{
    bool bSent = false;
    Run([this, &request, &bSent](Core::Now now, auto& out) { bSent = _session.TrySend(request, now, out); });
    if (!bSent)
    {
        return; // after the next registration
    }
    if (const auto* planOrNull = std::get_if<Protocol::ExecutionPlan>(&request.payload); planOrNull != nullptr)
    {
        _judge.NotePlanSent(planOrNull->planID);
    }
    if (const auto control = GetControlOrNull(Protocol::GetCommand(request)); control.has_value())
    {
        _judge.NoteControlSent(*control, GetPlanID(request.payload), request.transactionID);
    }
}

void McsSide::OnAck(const Protocol::AcsAck& ack)
{
    const auto control = GetControlOrNull(ack.command);
    if (ack.command == Protocol::EAcsCommand::ExecutionPlan)
    {
        _judge.NotePlanAck(ack);
    }
    else if (const auto found = _unanswered.find(ack.transactionID); control.has_value() && found != _unanswered.end())
    {
        _judge.NoteControlAck(*control, GetPlanID(found->second.payload), ack);
    }
    _unanswered.erase(ack.transactionID);
}

void McsSide::OnUnanswered(const std::string& transactionID)
{
    const auto found = _unanswered.find(transactionID);
    if (found == _unanswered.end())
    {
        return;
    }
    const bool bPlan = std::holds_alternative<Protocol::ExecutionPlan>(found->second.payload);
    if (!bPlan && !_bSettling && _chance.IsHit(400))
    {
        _unanswered.erase(found); // not requested any more
        return;
    }
    _behaviours.Post(_chance.GetBetween(0s, 5s), [this, transactionID] {
        if (const auto again = _unanswered.find(transactionID); again != _unanswered.end())
        {
            Send(MakeCopy(again->second));
        }
    });
}

void McsSide::SendPlan()
{
    const std::string planID = fmt::format("P{:02}", _planIDs.size() + 1);
    const bool bGood = !_scenario.Has(EFault::BadPlans) || !_chance.IsHit(250);
    Protocol::ExecutionPlan plan =
        bGood ? MakeGoodPlan(_scenario, _chance, planID) : MakeBadPlan(_scenario, _chance, planID);
    _planIDs.push_back(planID);
    _workChecker.NotePlan(plan);
    _judge.NotePlan(plan, bGood);
    const Protocol::AcsRequest request = _session.MakeRequest(std::move(plan), _timeline.GetNow());
    _unanswered.emplace(request.transactionID, request);
    Send(request);
    if (_planIDs.size() < _scenario.planCount)
    {
        _behaviours.Start(EBehaviour::SendPlan, _chance.GetBetween(0s, _chance.IsHit(400) ? 1s : 30s), [this] {
            SendPlan();
        });
    }
}

void McsSide::SendControl(Planning::EPlanControl control, const std::string& planID)
{
    const Protocol::AcsRequest request = _session.MakeRequest(MakeControl(control, planID), _timeline.GetNow());
    _unanswered.emplace(request.transactionID, request);
    Send(request);
}

void McsSide::SendRandomControl()
{
    // Mostly of the latest plans, because the others have ended.
    const std::size_t latest = std::min<std::size_t>(_planIDs.size(), 3);
    const std::size_t index =
        _chance.IsHit(800) ? _planIDs.size() - 1 - _chance.GetBelow(latest) : _chance.GetBelow(_planIDs.size());
    const std::string planID = _chance.IsHit(30) ? "UNKNOWN" : _planIDs[index];
    const std::vector<Planning::EPlanControl> controls{
        Planning::EPlanControl::Pause,
        Planning::EPlanControl::Pause,
        Planning::EPlanControl::Resume,
        Planning::EPlanControl::Resume,
        Planning::EPlanControl::Cancel,
        Planning::EPlanControl::Abort};
    for (std::size_t count = _chance.GetBetween(1, _chance.IsHit(200) ? 3 : 1); count > 0; --count)
    {
        SendControl(_chance.Pick(controls), planID);
    }
    _behaviours.Start(EBehaviour::SendControl, _chance.GetBetween(0s, _chance.IsHit(300) ? 2s : 30s), [this] {
        SendRandomControl();
    });
}

void McsSide::Ask()
{
    const auto ask = [this](Protocol::AcsPayload payload) {
        const Protocol::AcsRequest request = _session.MakeRequest(std::move(payload), _timeline.GetNow());
        _unanswered.emplace(request.transactionID, request);
        Send(request);
    };
    if (_chance.IsHit(500))
    {
        ask(Protocol::RequestAcsPlans{});
    }
    else
    {
        ask(Protocol::RequestAcsPlanHistory{_planIDs});
    }
    _behaviours.Start(EBehaviour::Ask, _chance.GetBetween(10s, 90s), [this] { Ask(); });
}

void McsSide::Misbehave()
{
    const Core::Now now = _timeline.GetNow();
    const auto span = std::chrono::milliseconds(_chance.GetBetween(500, 20'000));
    const std::vector<std::optional<Protocol::EAcsCommand>> commands{
        std::nullopt,
        std::nullopt,
        Protocol::EAcsCommand::PlanReport,
        Protocol::EAcsCommand::JobReport,
        Protocol::EAcsCommand::Registration};
    switch (_chance.GetBelow(4))
    {
        case 0:
            _trace.Add("MCS: Acks are late for {} ms", span.count());
            _session.HoldAcks(
                {_chance.Pick(commands), std::chrono::milliseconds(_chance.GetBetween(100, 12'000)), span},
                now);
            break;
        case 1:
            _trace.Add("MCS: no Acks for {} ms", span.count());
            _session.HoldAcks({_chance.Pick(commands), std::nullopt, span}, now);
            break;
        case 2:
            _session.RefuseRegistrations(_chance.GetBetween(1, 3), "not now");
            [[fallthrough]];
        default:
            _trace.Add("MCS: drops the connection");
            Run([this](Core::Now /*now*/, auto& out) {
                _session.Drop(Protocol::CLOSE_NORMAL, "requested by the simulation", out);
            });
            break;
    }
    _behaviours.Start(EBehaviour::Misbehave, _chance.GetBetween(1s, 60s), [this] { Misbehave(); });
}

/// Resumes every paused plan, repeatedly until it is not paused.
void McsSide::Settle()
{
    for (const auto& [transactionID, request] : MakeCopy(_unanswered))
    {
        Send(request);
    }
    for (const std::string& planID : _judge.GetPaused())
    {
        SendControl(Planning::EPlanControl::Resume, planID);
    }
    _behaviours.Start(EBehaviour::Settle, 60s, [this] { Settle(); });
}

} // namespace ACS::Simulation
