#include "McsLink.hpp"

#include "PlanMapper.hpp"
#include "ReportMapper.hpp"
#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Acsd
{

namespace
{

ProtocolBeast::ClientOptions MakeOptions(const AcsdConfig& config)
{
    ProtocolBeast::ClientOptions options;
    options.url = Apps::MakeText(config.mcs.url);
    options.tls = config.mcs.tls;
    options.headers = config.mcs.headers;
    options.link.pingInterval = config.mcs.pingInterval;
    options.session.ackTimeout = config.mcs.ackTimeout;
    options.session.ackRetries = config.mcs.ackRetries;
    options.session.positionInterval = config.positionInterval;
    return options;
}

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

/// Habits that cost nothing.
bool IsHarmless(Protocol::EProtocolNote what)
{
    switch (what)
    {
        case Protocol::EProtocolNote::UnknownMember:
        case Protocol::EProtocolNote::NullOptional:
        case Protocol::EProtocolNote::LenientWord:
        case Protocol::EProtocolNote::LenientNumber:
        case Protocol::EProtocolNote::BadTimestamp:
        case Protocol::EProtocolNote::DuplicateRequest:
            return true;
        case Protocol::EProtocolNote::Undecodable:
        case Protocol::EProtocolNote::UnknownCommand:
        case Protocol::EProtocolNote::AckMismatched:
        case Protocol::EProtocolNote::AckUnexpected:
        case Protocol::EProtocolNote::AckFailed:
        case Protocol::EProtocolNote::BeforeRegistered:
        case Protocol::EProtocolNote::RegistrationUnanswered:
        default:
            return false;
    }
}

std::size_t CountDigits(std::uint64_t number)
{
    return fmt::format_int(number).size();
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

McsLink::McsLink(
    const Core::IClock& clock,
    Core::Logger logger,
    const Apps::LocalOffset& localOffset,
    const Planning::PlanEngine& engine,
    CommandHandler handler)
    : _clock(clock),
      _logger(std::move(logger)),
      _localOffset(localOffset),
      _engine(engine),
      _handler(std::move(handler))
{
}

McsLink::~McsLink() = default;

Core::Result<void> McsLink::Open(
    const boost::asio::any_io_executor& executor,
    Core::IRandom& random,
    const AcsdConfig& config)
{
    auto client = ProtocolBeast::AcsClient::Create(executor, _clock, random, _logger, MakeOptions(config), *this);
    if (!client)
    {
        return tl::unexpected<Core::Error>(client.error());
    }
    _client = std::move(*client);
    _url = Apps::MakeText(config.mcs.url);
    _client->SetSiteOffset(GetOffset());
    return {};
}

void McsLink::Start()
{
    TellTsc(_engine.GetTscState());
    for (const Planning::RobotStatus& status : _engine.GetRobotStatuses())
    {
        TellStatus(status);
    }
    _client->Start();
}

void McsLink::StopAsync(StopHandler handler)
{
    _stopHandler = std::move(handler);
    _client->SendStatus(Protocol::AcsCommStateUpdate{false});
    _client->Stop();
}

void McsLink::Reply(const Planning::ReplyCommand& reply)
{
    const auto found = _openRequests.find(reply.replyToken);
    if (found == _openRequests.end())
    {
        return;
    }
    const OpenRequest request = std::move(found->second);
    _openRequests.erase(found);
    _client->Answer(
        request.command,
        request.transactionID,
        reply.bAccepted ? Protocol::EAckResult::Success : Protocol::EAckResult::Fail,
        reply.message,
        Protocol::PlanAck{request.planID});
}

void McsLink::Report(const Planning::OutboxEntry& entry)
{
    // Without a registration it stays in the engine's outbox, from which the next one is replayed.
    if (_client->IsRegistered())
    {
        _unsent.push_back(entry);
        Feed();
    }
}

void McsLink::TellStatus(const Planning::RobotStatus& status)
{
    _client->SendStatus(MakeStatusUpdate(status));
}

void McsLink::TellWorking(bool bWorking)
{
    _client->SendStatus(Protocol::AcsCommStateUpdate{bWorking});
}

void McsLink::TellTsc(Planning::ETscState state)
{
    _client->SendStatus(MakeTscUpdate(state));
}

bool McsLink::IsRegistered() const
{
    return _client->IsRegistered();
}

const Protocol::SessionStatistics& McsLink::GetStatistics() const
{
    return _client->GetStatistics();
}

void McsLink::OnSessionEvent(const Protocol::SessionEvent& event)
{
    std::visit(
        Core::Overloaded{
            [&](const Protocol::Registered&) {
                _logger.Info("registered with the MCS");
                _loggedOutage.clear();
                BeginReplay();
            },
            [&](const Protocol::RegistrationRefused& refused) {
                _logger.Warning("the MCS refuses the registration, trying again", {{"reason", refused.message}});
            },
            [&](const Protocol::RequestReceived& received) { TakeRequest(received.request); },
            [&](const Protocol::Acked& acked) { TakeAck(acked); },
            [&](const Protocol::RequestUnanswered& unanswered) {
                _logger.Warning(
                    "the MCS does not acknowledge",
                    {{"command", GetText(unanswered.command)}, {"transactionId", unanswered.transactionID}});
            },
            [&](const Protocol::WindowOpened&) { Feed(); },
            [&](const Protocol::PositionDue&) {
                _client->SetSiteOffset(GetOffset());
                _client->SendPosition(MakePositionUpdate(_engine.GetRobotPoses()));
            },
            [&](const Protocol::LinkLost& lost) {
                LogOutage(lost);
                _unsent.clear();
                _sequences.clear();
            },
            [&](const Protocol::Stopped&) {
                if (_stopHandler)
                {
                    std::exchange(_stopHandler, nullptr)();
                }
            },
            [&](const Protocol::ProtocolNoted& noted) { LogNote(noted); },
            [](const Protocol::AckReceived&) { /* of the MCS's side */ }},
        event);
}

void McsLink::LogNote(const Protocol::ProtocolNoted& noted)
{
    // The first, the tenth, the hundredth: an MCS that repeats its mistake does not fill the log.
    const std::uint64_t total = GetStatistics().CountOf(noted.what);
    const std::uint64_t before = total - std::min<std::uint64_t>(noted.count, total);
    if (before > 0 && CountDigits(before) == CountDigits(total))
    {
        return;
    }
    _logger.Write(
        IsHarmless(noted.what) ? Core::ELogLevel::Debug : Core::ELogLevel::Warning,
        "the MCS departs from the protocol",
        {{"what", GetText(noted.what)}, {"detail", noted.detail}, {"count", fmt::format_int(total).str()}});
}

void McsLink::LogOutage(const Protocol::LinkLost& lost)
{
    // Once per reason: every further try fails for the same one, or tells something new.
    if (_stopHandler || lost.reason == _loggedOutage)
    {
        return;
    }
    _loggedOutage = lost.reason;
    _logger.Warning(
        lost.bWasRegistered ? "lost the MCS, trying again until it answers"
                            : "cannot reach the MCS: start it or correct mcs.url; trying again until it answers",
        {{"url", _url}, {"reason", lost.reason}});
}

void McsLink::TakeRequest(const Protocol::AcsRequest& request)
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

void McsLink::AnswerQuery(const Protocol::AcsRequest& request)
{
    const auto answer =
        [&](Protocol::EAckResult result, std::string_view message, const Protocol::AckPayload& payload) {
            _client->Answer(Protocol::GetCommand(request), request.transactionID, result, message, payload);
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

void McsLink::AnswerHistory(const Protocol::AcsRequest& request, const Protocol::RequestAcsPlanHistory& query)
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
    _client->Answer(Protocol::GetCommand(request), request.transactionID, Protocol::EAckResult::Success, message, list);
}

void McsLink::TakeAck(const Protocol::Acked& acked)
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

void McsLink::BeginReplay()
{
    const std::vector<Planning::OutboxEntry> entries = _engine.GetUnacknowledged();
    _unsent.assign(entries.begin(), entries.end());
    _sequences.clear();
    _bReplaying = true;
    Feed();
}

void McsLink::Feed()
{
    while (!_unsent.empty())
    {
        const Planning::OutboxEntry& entry = _unsent.front();
        if (!_client->TrySendDurable(MakeReportRequest(entry, _localOffset.GetAt(entry.time))))
        {
            return; // WindowOpened or Registered comes
        }
        _sequences.emplace(entry.transactionID, entry.sequence);
        _unsent.pop_front();
    }
    if (std::exchange(_bReplaying, false))
    {
        _client->ReplayDone();
    }
}

std::chrono::minutes McsLink::GetOffset() const
{
    return _localOffset.GetAt(_clock.GetNow().wall);
}

} // namespace ACS::Acsd
