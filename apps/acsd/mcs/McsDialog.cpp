#include "mcs/McsDialog.hpp"

#include "mcs/PlanMapper.hpp"
#include "mcs/ReportMapper.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/plan/PlanTransitions.hpp>
#include <acs/protocol/AcsCodec.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <set>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Acsd
{

namespace
{

std::string GetPlanID(const Planning::PlanCommand& command)
{
    return std::visit(
        Core::Overloaded{
            [](const Planning::SubmitPlan& submit) { return submit.plan.planID; },
            [](const Planning::ControlPlan& control) { return control.planID; },
            [](const auto&) {
                return std::string();
            }},
        command);
}

std::string GetPlanID(const Planning::Report& report)
{
    return std::visit(
        Core::Overloaded{
            [](const Planning::ErrorReport& error) { return error.alarm.planID.value_or(std::string()); },
            [](const auto& ofPlan) {
                return ofPlan.planID;
            }},
        report);
}

/// Some by name: what the MCS has asked for may be longer than what it can read.
std::string DescribeUnknown(const std::vector<std::string_view>& planIDs)
{
    constexpr std::size_t MAX_NAMED = 20;
    std::string text;
    for (std::size_t i = 0; i < std::min(planIDs.size(), MAX_NAMED); ++i)
    {
        text += text.empty() ? "Unknown: " : ", ";
        text += planIDs[i];
    }
    return planIDs.size() > MAX_NAMED ? text + fmt::format(" and {} more", planIDs.size() - MAX_NAMED) : text;
}

/// What an MCS must hear even if it asks for the history: how plans ended, and what became of its controls.
bool IsReplayed(const Planning::Report& report, EOutboxReplay replay)
{
    const auto* const planOrNull = std::get_if<Planning::PlanReport>(&report);
    const bool bFinal = (planOrNull != nullptr && Planning::IsFinal(planOrNull->state))
        || std::holds_alternative<Planning::ControlResultReport>(report);
    return replay == EOutboxReplay::All || (replay == EOutboxReplay::FinalOnly && bFinal);
}

} // namespace

std::string CutReason(std::string_view reason)
{
    constexpr std::size_t LONGEST = 200;
    return std::string(reason.substr(0, std::min(reason.find(", found "), LONGEST)));
}

McsDialog::McsDialog(
    const Core::IClock& clock,
    Core::Logger logger,
    const Apps::LocalOffset& localOffset,
    const Planning::PlanEngine& engine,
    IMcsOutput& output,
    CommandHandler handler)
    : _clock(clock),
      _logger(std::move(logger)),
      _log(_logger),
      _localOffset(localOffset),
      _engine(engine),
      _output(output),
      _handler(std::move(handler))
{
}

void McsDialog::Restore(std::uint64_t lastSequence)
{
    _lastTold = lastSequence;
}

void McsDialog::SetStyle(MessageStyle style)
{
    _style = std::move(style);
}

void McsDialog::SetAckObserver(AckObserver observer)
{
    _ackObserver = std::move(observer);
}

void McsDialog::BeginDraining()
{
    _bDraining = true;
    TellWorking(false);
}

void McsDialog::Begin()
{
    _output.SetSiteOffset(GetOffset());
    TellTSC(_engine.GetTscState());
    for (const Planning::RobotStatus& status : _engine.GetRobotStatuses())
    {
        TellStatus(status);
    }
}

void McsDialog::OnSessionEvent(const Protocol::SessionEvent& event)
{
    _output.SetSiteOffset(GetOffset()); // summer time may have begun since the last one
    std::visit(
        Core::Overloaded{
            [&](const Protocol::Registered&) { BeginReplay(); },
            [&](const Protocol::RequestReceived& received) { TakeRequest(received.request); },
            [&](const Protocol::Acked& acked) { TakeAck(acked); },
            [&](const Protocol::WindowOpened&) { Feed(); },
            [&](const Protocol::PositionDue&) {
                for (const auto& update : MakePositionUpdates(_engine.GetRobotPoses(), _style))
                {
                    _output.SendPosition(update);
                }
            },
            [&](const Protocol::LinkLost&) {
                _bOpen = false;
                _unsent.clear();
                _sent.clear();
            },
            [](const auto&) { /* nothing to be done */ }},
        event);
}

void McsDialog::Reply(const Planning::ReplyCommand& reply)
{
    const auto found = _openRequests.find(reply.replyToken);
    if (found == _openRequests.end())
    {
        return;
    }
    const OpenRequest request = std::move(found->second);
    _openRequests.erase(found);
    LogAnswer(request, reply.bAccepted, reply.message);
    _output.Answer(
        request.command,
        request.transactionID,
        reply.bAccepted ? Protocol::EAckResult::Success : Protocol::EAckResult::Fail,
        reply.message,
        Protocol::PlanAck{request.planID});
}

void McsDialog::Report(const Planning::OutboxEntry& entry)
{
    _lastTold = entry.sequence;
    // Before the replay it stays in the engine's outbox, from which that is made.
    if (_bOpen)
    {
        _unsent.push_back(entry);
        Feed();
    }
}

void McsDialog::TellStatus(const Planning::RobotStatus& status)
{
    _output.SendStatus(MakeStatusUpdate(status, _style));
}

void McsDialog::TellWorking(bool bWorking)
{
    _output.SendStatus(Protocol::AcsCommStateUpdate{bWorking});
}

void McsDialog::TellTSC(Planning::ETscState state)
{
    _output.SendStatus(MakeTscUpdate(state));
}

void McsDialog::TakeRequest(const Protocol::AcsRequest& request)
{
    const Planning::ReplyToken token = ++_lastToken;
    std::optional<Planning::PlanCommand> commandOrNull =
        MakePlanCommandOrNull(request.payload, request.transactionID, token);
    if (!commandOrNull.has_value())
    {
        AnswerQuery(request);
        return;
    }
    const std::string planID = GetPlanID(*commandOrNull);
    if (_bDraining)
    {
        constexpr std::string_view REASON = "acsd draining for shutdown";
        LogAnswer({Protocol::GetCommand(request), request.transactionID, planID}, false, REASON);
        _output.Answer(
            Protocol::GetCommand(request),
            request.transactionID,
            Protocol::EAckResult::Fail,
            REASON,
            Protocol::PlanAck{planID});
        return;
    }
    _openRequests.emplace(token, OpenRequest{Protocol::GetCommand(request), request.transactionID, planID});
    _handler(std::move(*commandOrNull));
}

void McsDialog::LogAnswer(const OpenRequest& request, bool bAccepted, std::string_view reason)
{
    if (bAccepted)
    {
        _logger.Info(
            "command accepted",
            {{"command", GetText(request.command)},
             {"planId", request.planID},
             {"transactionId", request.transactionID},
             {"reason", reason}});
        return;
    }
    // "steps[0].action: expected …", but not "The plan cannot be stored: /var/acsd.db: expected …"
    const std::string_view before = reason.substr(0, reason.find(": expected "));
    const bool bField = before.size() < reason.size() && before.find(' ') == std::string_view::npos;
    _log.Write(
        _clock.GetNow().steady,
        Core::ELogLevel::Info,
        CutReason(reason),
        "command refused",
        {{"command", GetText(request.command)},
         {"planId", request.planID},
         {"transactionId", request.transactionID},
         {"reason", reason},
         {"field", bField ? before : std::string_view()}});
}

void McsDialog::AnswerQuery(const Protocol::AcsRequest& request)
{
    std::visit(
        Core::Overloaded{
            [&](const Protocol::RequestAcsPlans&) {
                Protocol::PlanListAck list;
                for (const Planning::PlanSummary& summary : _engine.GetActivePlans())
                {
                    list.plans.push_back(MakePlanEntry(summary, GetOffset(), _style));
                }
                AnswerList(request, {}, std::move(list), &Protocol::PlanListAck::plans);
            },
            [&](const Protocol::RequestAcsPlanHistory& query) { AnswerHistory(request, query); },
            [&](const Protocol::RequestAcsErrorList&) {
                Protocol::ErrorListAck list;
                for (const Planning::Alarm& alarm : _engine.GetActiveAlarms())
                {
                    list.errors.push_back(MakeErrorReport(alarm, true, _style));
                }
                AnswerList(request, {}, std::move(list), &Protocol::ErrorListAck::errors);
            },
            [&](const auto&) {
                _output.Answer(
                    Protocol::GetCommand(request),
                    request.transactionID,
                    Protocol::EAckResult::Fail,
                    "not supported",
                    Protocol::EmptyAck{});
            }},
        request.payload);
}

void McsDialog::AnswerHistory(const Protocol::AcsRequest& request, const Protocol::RequestAcsPlanHistory& query)
{
    Protocol::PlanListAck list;
    std::vector<std::string_view> unknown;
    std::set<std::string_view> seen;
    for (const std::string& planID : query.planIDs)
    {
        if (!seen.insert(planID).second)
        {
            continue;
        }
        const std::optional<Planning::PlanSummary> summary = _engine.GetPlanOrNull(planID);
        if (summary.has_value())
        {
            list.plans.push_back(MakePlanEntry(*summary, GetOffset(), _style));
        }
        else
        {
            unknown.push_back(planID);
        }
    }
    AnswerList(request, DescribeUnknown(unknown), std::move(list), &Protocol::PlanListAck::plans);
}

/// Section 12: an MCS that reads 4096 bytes loses a longer answer without a word; a shorter one says what it left out.
template <typename TList, typename TEntries>
void McsDialog::AnswerList(
    const Protocol::AcsRequest& request,
    const std::string& message,
    TList list,
    TEntries TList::*entries)
{
    TEntries all = std::exchange(list.*entries, {});
    const auto take = [&](std::size_t count) {
        list.*entries = TEntries(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(count));
        const std::size_t left = all.size() - count;
        const std::string note = left == 0 ? std::string() : fmt::format("{} more do not fit", left);
        return message.empty() || note.empty() ? message + note : message + "; " + note;
    };
    const auto fits = [&](std::size_t count) {
        const std::string text = take(count);
        Protocol::AcsAck ack{Protocol::GetCommand(request), request.transactionID, {}, {}, text, list, false};
        std::string encoded;
        Protocol::AcsCodec::EncodeAck(ack, encoded);
        return encoded.size() <= _style.longestText;
    };
    std::size_t count = all.size();
    if (_style.longestText > 0 && !fits(count))
    {
        if constexpr (std::is_same_v<TList, Protocol::ErrorListAck>)
        {
            std::ranges::reverse(all); // the newest are those that matter
        }
        std::size_t tooMany = count;
        count = 0;
        while (tooMany - count > 1)
        {
            const std::size_t middle = count + (tooMany - count) / 2;
            (fits(middle) ? count : tooMany) = middle;
        }
    }
    const std::string text = take(count);
    _output.Answer(Protocol::GetCommand(request), request.transactionID, Protocol::EAckResult::Success, text, list);
}

void McsDialog::TakeAck(const Protocol::Acked& acked)
{
    const auto found = _sent.find(acked.transactionID);
    if (found == _sent.end())
    {
        return;
    }
    const SentReport sent = found->second;
    _sent.erase(found);
    if (_ackObserver)
    {
        _ackObserver(acked, _clock.GetNow().steady - sent.sentAt);
    }
    if (acked.result == Protocol::EAckResult::Fail)
    {
        TakeRefusal(acked, sent);
        if (_style.bRefusedReportsRetried)
        {
            return;
        }
    }
    Acknowledge(sent.sequence);
}

/// Remembered, as the engine may be waiting for the disk: a replay meanwhile is made without it.
void McsDialog::Acknowledge(std::uint64_t sequence)
{
    if (_acknowledged.size() >= _acknowledgedLimit)
    {
        PruneAcknowledged(_engine.GetUnacknowledged());
        _acknowledgedLimit = std::max(FIRST_ACKNOWLEDGED_LIMIT, 2 * _acknowledged.size());
    }
    _acknowledged.insert(sequence);
    _handler(Planning::MessageAcknowledged{sequence});
}

void McsDialog::PruneAcknowledged(const std::vector<Planning::OutboxEntry>& outbox)
{
    std::erase_if(_acknowledged, [&outbox](std::uint64_t sequence) {
        return !std::ranges::binary_search(outbox, sequence, {}, &Planning::OutboxEntry::sequence);
    });
}

/// Final (register, mcs.on_report_nack): the MCS has it and does not want it. Or it is kept for the next connection.
void McsDialog::TakeRefusal(const Protocol::Acked& acked, const SentReport& sent)
{
    ++_refusedReports.count;
    _refusedReports.command = GetText(acked.command);
    _refusedReports.planID = sent.planID;
    _refusedReports.message = acked.message;
    _log.Write(
        _clock.GetNow().steady,
        Core::ELogLevel::Warning,
        fmt::format("{} {}", GetText(acked.command), CutReason(acked.message)),
        _style.bRefusedReportsRetried ? "the MCS refuses a report, it is sent again with the next registration"
                                      : "the MCS refuses a report",
        {{"command", GetText(acked.command)},
         {"planId", sent.planID},
         {"transactionId", acked.transactionID},
         {"reason", acked.message}});
}

const RefusedReports& McsDialog::GetRefusedReports() const noexcept
{
    return _refusedReports;
}

void McsDialog::BeginReplay()
{
    _unsent.clear();
    _sent.clear();
    std::vector<std::uint64_t> leftOut;
    std::vector<Planning::OutboxEntry> outbox = _engine.GetUnacknowledged();
    PruneAcknowledged(outbox);
    for (Planning::OutboxEntry& entry : outbox)
    {
        if (entry.sequence > _lastTold || _acknowledged.contains(entry.sequence))
        {
            continue; // still on its way to the disk, where it is told after, or from which it is removed
        }
        if (IsReplayed(entry.report, _style.replay))
        {
            _unsent.push_back(std::move(entry));
            continue;
        }
        leftOut.push_back(entry.sequence);
    }
    _bOpen = true;
    _bReplaying = true;
    if (!leftOut.empty())
    {
        _logger.Warning(
            "reports of the outage are left out, as outbox.replay says",
            {{"count", fmt::format_int(leftOut.size()).str()}});
    }
    for (const std::uint64_t sequence : leftOut)
    {
        Acknowledge(sequence);
    }
    Feed();
}

void McsDialog::Feed()
{
    while (!_unsent.empty())
    {
        const Planning::OutboxEntry& entry = _unsent.front();
        if (!_output.TrySendDurable(MakeReportRequest(entry, _localOffset.GetAt(entry.time), _style)))
        {
            return; // WindowOpened or Registered comes
        }
        _sent.insert_or_assign(
            entry.transactionID,
            SentReport{entry.sequence, _clock.GetNow().steady, GetPlanID(entry.report)});
        _unsent.pop_front();
    }
    if (std::exchange(_bReplaying, false))
    {
        _output.ReplayDone();
    }
}

std::chrono::minutes McsDialog::GetOffset() const
{
    return _localOffset.GetAt(_clock.GetNow().wall);
}

} // namespace ACS::Acsd
