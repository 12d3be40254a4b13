#include "McsDialog.hpp"

#include "PlanMapper.hpp"
#include "ReportMapper.hpp"
#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <set>
#include <string_view>
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

} // namespace

McsDialog::McsDialog(
    const Core::IClock& clock,
    Core::Logger logger,
    const Apps::LocalOffset& localOffset,
    const Planning::PlanEngine& engine,
    IMcsOutput& output,
    CommandHandler handler)
    : _clock(clock),
      _logger(std::move(logger)),
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

void McsDialog::Begin()
{
    _output.SetSiteOffset(GetOffset());
    TellTsc(_engine.GetTscState());
    for (const Planning::RobotStatus& status : _engine.GetRobotStatuses())
    {
        TellStatus(status);
    }
}

void McsDialog::OnSessionEvent(const Protocol::SessionEvent& event)
{
    std::visit(
        Core::Overloaded{
            [&](const Protocol::Registered&) { BeginReplay(); },
            [&](const Protocol::RequestReceived& received) { TakeRequest(received.request); },
            [&](const Protocol::Acked& acked) { TakeAck(acked); },
            [&](const Protocol::WindowOpened&) { Feed(); },
            [&](const Protocol::PositionDue&) {
                _output.SetSiteOffset(GetOffset());
                _output.SendPosition(MakePositionUpdate(_engine.GetRobotPoses()));
            },
            [&](const Protocol::LinkLost&) {
                _bOpen = false;
                _unsent.clear();
                _sequences.clear();
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
    _output.SendStatus(MakeStatusUpdate(status));
}

void McsDialog::TellWorking(bool bWorking)
{
    _output.SendStatus(Protocol::AcsCommStateUpdate{bWorking});
}

void McsDialog::TellTsc(Planning::ETscState state)
{
    _output.SendStatus(MakeTscUpdate(state));
}

void McsDialog::TakeRequest(const Protocol::AcsRequest& request)
{
    const Planning::ReplyToken token = ++_lastToken;
    std::optional<Planning::PlanCommand> commandOrNull = MakePlanCommandOrNull(request.payload, token);
    if (!commandOrNull.has_value())
    {
        AnswerQuery(request);
        return;
    }
    _openRequests.emplace(
        token,
        OpenRequest{Protocol::GetCommand(request), request.transactionID, GetPlanID(*commandOrNull)});
    _handler(std::move(*commandOrNull));
}

void McsDialog::AnswerQuery(const Protocol::AcsRequest& request)
{
    const auto answer =
        [&](Protocol::EAckResult result, std::string_view message, const Protocol::AckPayload& payload) {
            _output.Answer(Protocol::GetCommand(request), request.transactionID, result, message, payload);
        };
    std::visit(
        Core::Overloaded{
            [&](const Protocol::RequestAcsPlans&) {
                Protocol::PlanListAck list;
                for (const Planning::PlanSummary& summary : _engine.GetActivePlans())
                {
                    list.plans.push_back(MakePlanEntry(summary, GetOffset()));
                }
                answer(Protocol::EAckResult::Success, "", list);
            },
            [&](const Protocol::RequestAcsPlanHistory& query) { AnswerHistory(request, query); },
            [&](const Protocol::RequestAcsErrorList&) {
                Protocol::ErrorListAck list;
                for (const Planning::Alarm& alarm : _engine.GetActiveAlarms())
                {
                    list.errors.push_back(MakeErrorReport(alarm, true));
                }
                answer(Protocol::EAckResult::Success, "", list);
            },
            [&](const auto&) {
                answer(Protocol::EAckResult::Fail, "not supported", Protocol::EmptyAck{});
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
            list.plans.push_back(MakePlanEntry(*summary, GetOffset()));
        }
        else
        {
            unknown.push_back(planID);
        }
    }
    const std::string message = DescribeUnknown(unknown);
    _output.Answer(Protocol::GetCommand(request), request.transactionID, Protocol::EAckResult::Success, message, list);
}

void McsDialog::TakeAck(const Protocol::Acked& acked)
{
    const auto found = _sequences.find(acked.transactionID);
    if (found == _sequences.end())
    {
        return;
    }
    if (acked.result == Protocol::EAckResult::Fail)
    {
        // Final all the same (register D-1, mcs.on_report_nack): the MCS has it and does not want it.
        _logger.Warning(
            "the MCS refuses a report",
            {{"command", GetText(acked.command)}, {"transactionId", acked.transactionID}, {"reason", acked.message}});
    }
    const std::uint64_t sequence = found->second;
    _sequences.erase(found);
    _handler(Planning::MessageAcknowledged{sequence});
}

void McsDialog::BeginReplay()
{
    _unsent.clear();
    for (Planning::OutboxEntry& entry : _engine.GetUnacknowledged())
    {
        // What is still on its way to the disk is told when it is there.
        if (entry.sequence <= _lastTold)
        {
            _unsent.push_back(std::move(entry));
        }
    }
    _sequences.clear();
    _bOpen = true;
    _bReplaying = true;
    Feed();
}

void McsDialog::Feed()
{
    while (!_unsent.empty())
    {
        const Planning::OutboxEntry& entry = _unsent.front();
        if (!_output.TrySendDurable(MakeReportRequest(entry, _localOffset.GetAt(entry.time))))
        {
            return; // WindowOpened or Registered comes
        }
        _sequences.emplace(entry.transactionID, entry.sequence);
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
