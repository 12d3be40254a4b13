#include "mcs/McsGateway.hpp"

#include "mcs/PlanMapper.hpp"
#include "mcs/ReportMapper.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/core/ShortText.hpp>
#include <acs/plan/PlanTransitions.hpp>
#include <acs/protocol/AcsCodec.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <iterator>
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

/// Empty if the report is not about a plan.
std::string GetPlanID(const Protocol::AcsPayload& report)
{
    std::optional<std::string> planIDOrNull;
    std::visit(
        [&planIDOrNull](const auto& payload) {
            if constexpr (requires { payload.planID; })
            {
                planIDOrNull = payload.planID;
            }
        },
        report);
    return planIDOrNull.value_or(std::string());
}

/// Names only some: the list that the MCS requested may be longer than its buffer.
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

/// Whether the MCS needs the report even if it requests the history: how plans ended, and the outcome of its controls.
bool IsReplayed(const Protocol::AcsPayload& report, EOutboxReplay replay)
{
    const bool bFinal = std::visit(
        Core::Overloaded{
            [](const Protocol::PlanReport& plan) { return Protocol::IsFinal(plan.status); },
            [](const Protocol::CancelResultReport&) { return true; },
            [](const Protocol::AbortResultReport&) { return true; },
            [](const Protocol::PauseResultReport&) { return true; },
            [](const Protocol::ResumeResultReport&) { return true; },
            [](const auto& /*other*/) {
                return false;
            }},
        report);
    return replay == EOutboxReplay::All || (replay == EOutboxReplay::FinalOnly && bFinal);
}

} // namespace

std::string CutReason(std::string_view reason)
{
    constexpr std::size_t LONGEST = 200;
    return std::string(reason.substr(0, std::min(reason.find(", found "), LONGEST)));
}

McsGateway::McsGateway(
    const Core::IClock& clock,
    Core::IRandom& random,
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
      _handler(std::move(handler)),
      _outbox(*this, random)
{
}

void McsGateway::Restore(const std::vector<Planning::OutboxEntry>& entries)
{
    std::vector<Protocol::DurableRequest> requests;
    std::ranges::transform(entries, std::back_inserter(requests), [this](const Planning::OutboxEntry& entry) {
        return MakeRequest(entry);
    });
    _outbox.Restore(std::move(requests));
}

void McsGateway::SetStyle(MessageStyle style)
{
    _style = std::move(style);
}

void McsGateway::SetAckObserver(AckObserver observer)
{
    _ackObserver = std::move(observer);
}

void McsGateway::BeginDraining()
{
    _bDraining = true;
    PublishWorking(false);
}

void McsGateway::Begin()
{
    _output.SetSiteOffset(GetOffset());
    PublishTscState(_engine.GetTscState());
    for (const Planning::RobotStatus& status : _engine.GetRobotStatuses())
    {
        PublishStatus(status);
    }
}

void McsGateway::OnSessionEvent(const Protocol::SessionEvent& event)
{
    _output.SetSiteOffset(GetOffset()); // daylight saving time may have begun
    std::visit(
        Core::Overloaded{
            [&](const Protocol::Registered&) { BeginReplay(); },
            [&](const Protocol::RequestReceived& received) { HandleRequest(received.request); },
            [&](const Protocol::Acked& acked) { HandleAck(acked); },
            [&](const Protocol::WindowOpened&) { Feed(); },
            [&](const Protocol::PositionDue&) {
                for (const auto& update : MakePositionUpdates(_engine.GetRobotPoses(), _style))
                {
                    _output.SendPosition(update);
                }
            },
            [&](const Protocol::LinkLost&) { EndConnection(event); },
            [&](const Protocol::Stopped&) { EndConnection(event); },
            [](const auto&) { /* nothing to be done */ }},
        event);
}

void McsGateway::Reply(const Planning::ReplyCommand& reply)
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

void McsGateway::Report(const Planning::SendReport& report)
{
    if (report.replaced.has_value())
    {
        _outbox.Drop(*report.replaced);
    }
    _outbox.Queue(MakeRequest(report.entry));
    Feed();
}

void McsGateway::PublishStatus(const Planning::RobotStatus& status)
{
    _output.SendStatus(MakeStatusUpdate(status, _style));
}

void McsGateway::PublishWorking(bool bWorking)
{
    _bWorking = bWorking;
    _bWorkingPublished = _output.IsRegistered() ? bWorking : _bWorkingPublished;
    _output.SendStatus(Protocol::AcsCommStateUpdate{bWorking});
}

void McsGateway::PublishTscState(Planning::ETscState state)
{
    _output.SendStatus(MakeTscUpdate(state));
}

void McsGateway::HandleRequest(const Protocol::AcsRequest& request)
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

void McsGateway::LogAnswer(const OpenRequest& request, bool bAccepted, std::string_view reason)
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

void McsGateway::AnswerQuery(const Protocol::AcsRequest& request)
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

void McsGateway::AnswerHistory(const Protocol::AcsRequest& request, const Protocol::RequestAcsPlanHistory& query)
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

/// Profile nexus: an MCS with a buffer of 4096 bytes silently loses a longer answer. A cut one states the number of omitted
/// entries.
template <typename TList, typename TEntries>
void McsGateway::AnswerList(
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
            std::ranges::reverse(all); // the newest errors matter most
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

void McsGateway::HandleAck(const Protocol::Acked& acked)
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
        _ackObserver(_clock.GetNow().steady - sent.sentAt);
    }
    if (acked.result == Protocol::EAckResult::Fail)
    {
        HandleRefusal(acked, sent);
        if (_style.bRefusedReportsRetried)
        {
            return;
        }
    }
    static_cast<void>(_outbox.OnEvent(acked)); // Remove does not fail
}

/// By default the refusal is final (register, mcs.on_report_nack). With "retry" the report is kept for the next connection.
void McsGateway::HandleRefusal(const Protocol::Acked& acked, const SentReport& sent)
{
    ++_refusedReports.count;
    ++_refusedReports.byCommand.at(static_cast<std::size_t>(acked.command));
    _refusedReports.command = GetText(acked.command);
    _refusedReports.planID = sent.planID;
    _refusedReports.message = Core::ShortenText(acked.message);
    _refusedReports.bRetried = _style.bRefusedReportsRetried;
    _log.Write(
        _clock.GetNow().steady,
        Core::ELogLevel::Warning,
        fmt::format("{} {}", GetText(acked.command), CutReason(acked.message)),
        _style.bRefusedReportsRetried ? "the MCS refuses a report, it is sent again after the next registration"
                                      : "the MCS refuses a report",
        {{"command", GetText(acked.command)},
         {"planId", sent.planID},
         {"transactionId", acked.transactionID},
         {"reason", _refusedReports.message}});
}

const RefusedReports& McsGateway::GetRefusedReports() const noexcept
{
    return _refusedReports;
}

std::optional<bool> McsGateway::GetPublishedWorkingOrNull() const noexcept
{
    return _bWorkingPublished;
}

void McsGateway::BeginReplay()
{
    _sent.clear();
    const Core::Result<std::size_t> discarded = _outbox.Discard([this](const Protocol::DurableRequest& request) {
        return !IsReplayed(request.request.payload, _style.replay);
    });
    if (discarded.has_value() && *discarded > 0)
    {
        _logger.Warning(
            "reports of the outage are not sent, because of outbox.replay",
            {{"count", fmt::format_int(*discarded).str()}});
    }
    static_cast<void>(_outbox.OnEvent(Protocol::Registered{})); // removes nothing
    Feed();
}

void McsGateway::EndConnection(const Protocol::SessionEvent& event)
{
    static_cast<void>(_outbox.OnEvent(event)); // removes nothing
    _sent.clear();
}

void McsGateway::Feed()
{
    struct Session
    {
        McsGateway& gateway;

        [[nodiscard]] bool TrySendDurable(const Protocol::AcsRequest& request)
        {
            const bool bSent = gateway._output.TrySendDurable(request);
            if (bSent)
            {
                gateway._sent.insert_or_assign(
                    request.transactionID,
                    SentReport{gateway._clock.GetNow().steady, GetPlanID(request.payload)});
            }
            return bSent;
        }

        void ReplayDone()
        {
            gateway._output.ReplayDone();
            gateway._bWorkingPublished = gateway._bWorking; // The session sends the states after the replay.
        }
    };
    Session session{*this};
    _outbox.Feed(session);
}

Protocol::DurableRequest McsGateway::MakeRequest(const Planning::OutboxEntry& entry) const
{
    return {entry.sequence, MakeReportRequest(entry, _localOffset.GetAt(entry.time), _style)};
}

Core::Result<void> McsGateway::Append(const Protocol::DurableRequest& /*request*/)
{
    assert(false && "a report is stored with the plan's state");
    return Core::Fail(Core::ECoreError::QueueFull, "outbox", "reports from the engine only", "a report of the gateway");
}

Core::Result<void> McsGateway::Remove(std::uint64_t sequence)
{
    _handler(Planning::MessageAcknowledged{sequence});
    return {};
}

std::chrono::minutes McsGateway::GetOffset() const
{
    return _localOffset.GetAt(_clock.GetNow().wall);
}

} // namespace ACS::Acsd
