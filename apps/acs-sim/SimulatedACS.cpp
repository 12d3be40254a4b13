#include "SimulatedACS.hpp"

#include "common/log/LogText.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/core/Result.hpp>
#include <acs/core/Timestamp.hpp>
#include <acs/core/Uuid.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

namespace ACS::AcsSim
{

using Core::QuoteForError;
using Protocol::EJobStatus;
using Protocol::EStepStatus;

namespace
{

/// A report that another report of the plan always follows.
bool HasSuccessor(const Protocol::AcsPayload& payload)
{
    const auto* const stepOrNull = std::get_if<Protocol::StepReport>(&payload);
    const auto* const jobOrNull = std::get_if<Protocol::JobReport>(&payload);
    return (stepOrNull != nullptr && stepOrNull->status == EStepStatus::Dispatched)
        || (jobOrNull != nullptr && jobOrNull->status == EJobStatus::Instructed);
}

/// As the session distinguishes requests.
std::string MakeAnswerKey(Protocol::EAcsCommand command, std::string_view transactionID)
{
    return fmt::format("{} {}", GetText(command), transactionID);
}

} // namespace

SimulatedACS::SimulatedACS(Options options, IAcsLink& link, McsJudge& judge, Core::IRandom& random, Printer print)
    : _options(std::move(options)),
      _link(link),
      _judge(judge),
      _random(random),
      _print(std::move(print)),
      _executor(_options.executor),
      _outbox(_store, random),
      _schedule(_options.faults)
{
}

void SimulatedACS::Start()
{
    SendStates();
}

void SimulatedACS::SendStates()
{
    ExecutorActions actions;
    _executor.Report(actions);
    for (const ExecutorAction& action : actions)
    {
        if (const auto* const statusOrNull = std::get_if<SendStatus>(&action); statusOrNull != nullptr)
        {
            _link.SendStatus(statusOrNull->payload);
        }
    }
}

void SimulatedACS::Feed()
{
    if (!_heldUntil.has_value())
    {
        _outbox.Feed(_link);
    }
}

// ---- events of the session

void SimulatedACS::OnEvent(const Protocol::SessionEvent& event, Core::Now now)
{
    std::visit(
        Core::Overloaded{
            [&](const Protocol::Registered& registered) {
                static_cast<void>(_outbox.OnEvent(registered));
                OnRegistered(now);
            },
            [&](const Protocol::LinkLost& lost) {
                static_cast<void>(_outbox.OnEvent(lost));
                _judge.OnClosed(false);
                _nextFault.reset();
                _print(fmt::format("connection lost: {}", Apps::MakePrintable(lost.reason)));
            },
            [&](const Protocol::Stopped& stopped) {
                static_cast<void>(_outbox.OnEvent(stopped));
                _judge.OnClosed(true);
            },
            [&](const Protocol::Acked& acked) { OnAcked(acked, now); },
            [&](const Protocol::RequestReceived& received) { OnRequest(received.request, now); },
            [&](const Protocol::RequestRefused& refused) {
                _print(
                    fmt::format("{} refused: {}", QuoteForError(refused.commandName), QuoteForError(refused.reason)));
            },
            [&](const Protocol::PositionDue& /*due*/) { _link.SendPosition(_executor.MakePositions()); },
            [](const auto& /*other*/) {
            }},
        event);
    Feed();
    NoteGoal();
}

void SimulatedACS::OnRegistered(Core::Now now)
{
    ++_registrations;
    _nextFault = now.steady + _options.faultInterval;
    _print("registered");
}

void SimulatedACS::OnAcked(const Protocol::Acked& acked, Core::Now now)
{
    const auto& requests = _outbox.GetRequests();
    const auto found = std::ranges::find_if(requests, [&acked](const Protocol::DurableRequest& durable) {
        return durable.request.transactionID == acked.transactionID;
    });
    if (found == requests.end())
    {
        return;
    }
    if (TryUse(EFault::Reconnect))
    {
        // The outbox does not see the Ack: it sends the report again on the next connection.
        _cutAt = now.steady;
        return;
    }
    const Protocol::AcsRequest request = found->request;
    static_cast<void>(_outbox.OnEvent(acked));
    if (TryUse(EFault::DuplicateReport))
    {
        static_cast<void>(_link.TrySendDurable(request));
    }
}

void SimulatedACS::OnRequest(const Protocol::AcsRequest& request, Core::Now now)
{
    const SendAnswer* const answeredOrNull =
        _answers.FindOrNull(MakeAnswerKey(GetCommand(request), request.transactionID));
    if (answeredOrNull != nullptr)
    {
        SendAnswerNow(*answeredOrNull);
        return;
    }
    if (std::holds_alternative<Protocol::ExecutionPlan>(request.payload) && TryUse(EFault::RefusePlan))
    {
        _executor.RefuseNextPlan();
    }
    ExecutorActions actions;
    _executor.OnRequest(request, now, actions);
    Execute(actions, now);
}

// ---- what the executor wants

void SimulatedACS::Execute(const ExecutorActions& actions, Core::Now now)
{
    for (const ExecutorAction& action : actions)
    {
        std::visit(
            Core::Overloaded{
                [&](const SendReport& report) { Report(report.payload, now); },
                [&](const SendStatus& status) { _link.SendStatus(status.payload); },
                [&](const SendAnswer& answer) { Answer(answer, now); },
                [&](const PlanEnded& ended) {
                    _print(fmt::format("plan {} {}", QuoteForError(ended.planID), GetText(ended.status)));
                }},
            action);
    }
    Feed();
}

void SimulatedACS::Report(const Protocol::AcsPayload& payload, Core::Now now)
{
    const Core::Timestamp time{now.wall, _options.executor.siteOffset};
    if (!_heldUntil.has_value() && TryUse(EFault::LateReport))
    {
        _heldUntil = now.steady + _options.faultTime;
    }
    if (!_kept.has_value() && HasSuccessor(payload) && TryUse(EFault::OutOfOrder))
    {
        _kept = KeptReport{payload, time};
        return;
    }
    AddReport(payload, time, _kept.has_value());
    if (_kept.has_value())
    {
        AddReport(_kept->first, _kept->second, true);
        _kept.reset();
    }
}

void SimulatedACS::AddReport(const Protocol::AcsPayload& payload, const Core::Timestamp& time, bool bExcused)
{
    static_cast<void>(_outbox.Add(payload, time)); // This store has no errors.
    if (bExcused)
    {
        _judge.Excuse(_outbox.GetRequests().back().request.transactionID);
    }
}

void SimulatedACS::Answer(const SendAnswer& answer, Core::Now now)
{
    _answers.Add(MakeAnswerKey(answer.command, answer.transactionID), answer);
    if (TryUse(EFault::LateAck))
    {
        _lateAnswers.emplace_back(now.steady + _options.faultTime, answer);
        return;
    }
    SendAnswerNow(answer);
}

void SimulatedACS::SendAnswerNow(const SendAnswer& answer)
{
    _print(fmt::format("{}: {} {}", GetText(answer.command), GetText(answer.result), answer.message));
    _link.Answer(answer.command, answer.transactionID, answer.result, answer.message, answer.payload);
}

// ---- time

std::optional<Core::SteadyTime> SimulatedACS::GetNextDueOrNull() const
{
    std::optional<Core::SteadyTime> next = _executor.GetNextDueOrNull();
    const auto consider = [&next](const std::optional<Core::SteadyTime>& dueOrNull) {
        if (dueOrNull.has_value() && (!next.has_value() || *dueOrNull < *next))
        {
            next = dueOrNull;
        }
    };
    consider(_heldUntil);
    consider(_connectedAgain);
    consider(_nextFault);
    consider(_cutAt);
    for (const auto& [due, answer] : _lateAnswers)
    {
        consider(due);
    }
    return next;
}

void SimulatedACS::OnTimer(Core::Now now)
{
    const auto isDue = [&now](const std::optional<Core::SteadyTime>& dueOrNull) {
        return dueOrNull.has_value() && *dueOrNull <= now.steady;
    };
    if (isDue(_cutAt))
    {
        Cut();
    }
    if (isDue(_heldUntil))
    {
        _heldUntil.reset();
    }
    if (isDue(_connectedAgain))
    {
        _connectedAgain.reset();
        _link.SendStatus(Protocol::AcsCommStateUpdate{true});
    }
    for (const auto& [due, answer] : _lateAnswers)
    {
        if (due <= now.steady)
        {
            SendAnswerNow(answer);
        }
    }
    std::erase_if(_lateAnswers, [&now](const auto& entry) { return entry.first <= now.steady; });
    if (isDue(_nextFault))
    {
        const std::optional<EFault> fault = _schedule.ExtractNextOrNull();
        _nextFault = fault.has_value() ? std::optional(now.steady + _options.faultInterval) : std::nullopt;
        if (fault.has_value())
        {
            BeginFault(*fault, now);
        }
    }
    ExecutorActions actions;
    _executor.OnTimer(now, actions);
    Execute(actions, now);
    NoteGoal();
}

// ---- faults

bool SimulatedACS::TryUse(EFault fault)
{
    const auto found = _armed.find(fault);
    if (found == _armed.end())
    {
        return false;
    }
    if (--found->second == 0)
    {
        _armed.erase(found);
    }
    _print(fmt::format("fault: {}", GetName(fault)));
    return true;
}

std::string SimulatedACS::MakeText(const std::string& command, const std::string& payload, Core::Now now)
{
    return fmt::format(
        R"({{"command":"{}","transactionId":"{}","timestamp":"{}","payload":{}}})",
        command,
        Core::MakeUUID(_random),
        Core::FormatLocal(now.wall, _options.executor.siteOffset),
        payload);
}

void SimulatedACS::BeginFault(EFault fault, Core::Now now)
{
    switch (fault)
    {
        case EFault::LateReport:
        case EFault::DuplicateReport:
        case EFault::OutOfOrder:
        case EFault::LateAck:
        case EFault::RefusePlan:
        case EFault::Reconnect:
            ++_armed[fault];
            return;
        case EFault::FailJob:
            _executor.FailNextJob();
            break;
        case EFault::UnknownReport:
            Report(Protocol::PlanReport{Core::MakeUUID(_random), Protocol::EPlanStatus::InProgress, ""}, now);
            break;
        case EFault::UnknownCommand:
            _link.SendText(MakeText("InventedCommand", "{}", now));
            break;
        case EFault::BadPayload:
            // An ErrorReport, because the ACS sends no other: its Ack cannot be that of another one.
            _link.SendText(MakeText("ErrorReport", R"({"state":true})", now));
            break;
        case EFault::Malformed:
            _link.SendText(R"({"command":"PlanReport","transactionId":)");
            SendStates(); // Something that the MCS must answer follows.
            break;
        case EFault::UnknownAck:
            _link.Answer(
                Protocol::EAcsCommand::ExecutionPlan,
                Core::MakeUUID(_random),
                Protocol::EAckResult::Success,
                "",
                Protocol::PlanAck{"unknown"});
            break;
        case EFault::NotConnected:
            _connectedAgain = now.steady + _options.faultTime;
            _nextFault = *_connectedAgain + _options.faultInterval;
            _link.SendStatus(Protocol::AcsCommStateUpdate{false});
            break;
        default:
            break;
    }
    _print(fmt::format("fault: {}", GetName(fault)));
}

void SimulatedACS::Cut()
{
    _cutAt.reset();
    _nextFault.reset();
    _connectedAgain.reset();
    _lateAnswers.clear();
    _judge.OnClosed(true);
    static_cast<void>(_outbox.OnEvent(Protocol::LinkLost{"cut", true}));
    _link.Cut();
    SendStates();
}

// ---- the end

std::set<std::string> SimulatedACS::ListWaiting() const
{
    std::set<std::string> waiting = _judge.ListOpenRequests();
    for (const Protocol::DurableRequest& durable : _outbox.GetRequests())
    {
        if (!_judge.IsOverdue(durable.request.transactionID))
        {
            waiting.insert(durable.request.transactionID);
        }
    }
    for (const auto& [due, answer] : _lateAnswers)
    {
        waiting.insert(answer.transactionID);
    }
    return waiting;
}

void SimulatedACS::NoteGoal()
{
    if (_options.plans > 0 && _executor.CountEnded() >= _options.plans && !_schedule.HasCounted()
        && !_lastWaiting.has_value())
    {
        _lastWaiting = ListWaiting();
    }
}

bool SimulatedACS::IsDone() const
{
    if (!_lastWaiting.has_value() || _connectedAgain.has_value() || _cutAt.has_value())
    {
        return false;
    }
    // An MCS may send more plans: what came later does not count.
    const std::set<std::string> waiting = ListWaiting();
    return std::ranges::none_of(*_lastWaiting, [&waiting](const std::string& transactionID) {
        return waiting.contains(transactionID);
    });
}

bool SimulatedACS::WasRegistered() const
{
    return _registrations > 0;
}

std::size_t SimulatedACS::CountEndedPlans() const
{
    return _executor.CountEnded();
}

std::vector<EFault> SimulatedACS::ListArmedFaults() const
{
    std::vector<EFault> faults;
    faults.reserve(_armed.size());
    for (const auto& [fault, count] : _armed)
    {
        faults.push_back(fault);
    }
    return faults;
}

} // namespace ACS::AcsSim
