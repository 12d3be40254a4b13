#pragma once

#include "common/config/LocalOffset.hpp"
#include "common/log/LogRateLimiter.hpp"
#include "mcs/IMcsOutput.hpp"
#include "mcs/MessageStyle.hpp"
#include "mcs/RefusedReports.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/EngineAction.hpp>
#include <acs/plan/PlanCommand.hpp>
#include <acs/plan/PlanEngine.hpp>
#include <acs/plan/Report.hpp>
#include <acs/plan/RobotStatus.hpp>
#include <acs/protocol/DurableOutbox.hpp>
#include <acs/protocol/IOutboxStore.hpp>
#include <acs/protocol/SessionEvent.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace ACS::Acsd
{

/// The reason of a refusal without the value that was found. Refusals with the same result count as repetitions in the log.
[[nodiscard]] std::string CutReason(std::string_view reason);

/// The MCS side of acsd: passes requests to the engine as commands, answers them, sends the reports of the engine through the
/// session and returns their acknowledgements. Pure: the caller owns the session.
class McsGateway final : private Protocol::IOutboxStore
{
public:
    /// Receives the next command of the engine. The engine may answer within the call: the handler may call Reply, Report,
    /// PublishStatus and PublishTscState, and nothing else.
    using CommandHandler = std::function<void(Planning::PlanCommand command)>;
    /// Receives the time from sending a report on this connection to its Ack.
    using AckObserver = std::function<void(Core::Duration wait)>;

private:
    /// A command of the MCS that waits for the engine's reply.
    struct OpenRequest
    {
        Protocol::EAcsCommand command = Protocol::EAcsCommand::ExecutionPlan;
        std::string transactionID;
        std::string planID;
    };

    /// A report that was sent on this connection.
    struct SentReport
    {
        Core::SteadyTime sentAt;
        std::string planID; ///< Empty if it is not about a plan.
    };

    const Core::IClock& _clock;
    Core::Logger _logger;
    Apps::LogRateLimiter _log; ///< For lines that the MCS can trigger.
    Apps::LocalOffset _localOffset;
    const Planning::PlanEngine& _engine;
    IMcsOutput& _output;
    CommandHandler _handler;
    std::map<Planning::ReplyToken, OpenRequest> _openRequests;
    Planning::ReplyToken _lastToken = 0;
    Protocol::DurableOutbox _outbox;                   ///< The reports that are stored and not acknowledged.
    std::unordered_map<std::string, SentReport> _sent; ///< By transactionId.
    bool _bDraining = false;
    MessageStyle _style;
    AckObserver _ackObserver;
    RefusedReports _refusedReports;
    std::optional<bool> _bWorking; ///< The last value of PublishWorking.
    std::optional<bool> _bWorkingPublished;

public:
    /// Clock, random source, engine and output must outlive the gateway.
    McsGateway(
        const Core::IClock& clock,
        Core::IRandom& random,
        Core::Logger logger,
        const Apps::LocalOffset& localOffset,
        const Planning::PlanEngine& engine,
        IMcsOutput& output,
        CommandHandler handler);

    /// Call once with the reports of the store, after SetStyle and before all functions that send.
    void Restore(const std::vector<Planning::OutboxEntry>& entries);

    /// In effect from the next message; a report that is already queued keeps the style it has. Without a style, messages
    /// are written as MCS-ACS defines them.
    void SetStyle(MessageStyle style);
    void SetAckObserver(AckObserver observer);

    /// Refuses plans and controls from now on, because acsd stops.
    void BeginDraining();

    /// Call once, before the session starts. Sets the states of TSC and robots that the session reports.
    void Begin();

    /// Handles an event of the session.
    void OnSessionEvent(const Protocol::SessionEvent& event);

    void Reply(const Planning::ReplyCommand& reply);
    void Report(const Planning::SendReport& report);
    void PublishStatus(const Planning::RobotStatus& status);
    void PublishWorking(bool bWorking);
    void PublishTscState(Planning::ETscState state);

    [[nodiscard]] const RefusedReports& GetRefusedReports() const noexcept;
    /// The value of PublishWorking that the MCS was sent last; nullopt: none.
    [[nodiscard]] std::optional<bool> GetPublishedWorkingOrNull() const noexcept;

private:
    void HandleRequest(const Protocol::AcsRequest& request);
    template <typename TList, typename TEntries>
    void AnswerList(
        const Protocol::AcsRequest& request,
        const std::string& message,
        TList list,
        TEntries TList::*entries);
    void LogAnswer(const OpenRequest& request, bool bAccepted, std::string_view reason);
    void AnswerQuery(const Protocol::AcsRequest& request);
    void AnswerHistory(const Protocol::AcsRequest& request, const Protocol::RequestAcsPlanHistory& query);
    void HandleAck(const Protocol::Acked& acked);
    void HandleRefusal(const Protocol::Acked& acked, const SentReport& sent);
    void BeginReplay();
    void EndConnection(const Protocol::SessionEvent& event);
    void Feed();
    [[nodiscard]] Protocol::DurableRequest MakeRequest(const Planning::OutboxEntry& entry) const;
    [[nodiscard]] Core::Result<void> Append(const Protocol::DurableRequest& request) override;
    [[nodiscard]] Core::Result<void> Remove(std::uint64_t sequence) override;
    [[nodiscard]] std::chrono::minutes GetOffset() const;
};

} // namespace ACS::Acsd
