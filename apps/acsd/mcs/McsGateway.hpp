#pragma once

#include "common/config/LocalOffset.hpp"
#include "common/log/LogRateLimiter.hpp"
#include "mcs/IMcsOutput.hpp"
#include "mcs/MessageStyle.hpp"
#include "mcs/RefusedReports.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/plan/PlanCommand.hpp>
#include <acs/plan/PlanEngine.hpp>
#include <acs/plan/Report.hpp>
#include <acs/plan/RobotStatus.hpp>
#include <acs/protocol/SessionEvent.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace ACS::Acsd
{

/// Of a refusal what it is about, without what was found: refusals of which this is the same are alike.
[[nodiscard]] std::string CutReason(std::string_view reason);

/// The MCS side of acsd: passes requests to the engine as commands, answers them, sends the engine's outbox through the
/// session and reports acknowledgements to the engine. Pure: the session is the caller's.
class McsGateway final
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

    /// A report that this connection was given.
    struct SentReport
    {
        std::uint64_t sequence = 0;
        Core::SteadyTime sentAt;
        std::string planID; ///< Empty for what belongs to none.
    };

    static constexpr std::size_t FIRST_ACKNOWLEDGED_LIMIT = 1000;

    const Core::IClock& _clock;
    Core::Logger _logger;
    Apps::LogRateLimiter _log; ///< For what the MCS can make come in a flood.
    Apps::LocalOffset _localOffset;
    const Planning::PlanEngine& _engine;
    IMcsOutput& _output;
    CommandHandler _handler;
    std::map<Planning::ReplyToken, OpenRequest> _openRequests;
    Planning::ReplyToken _lastToken = 0;
    std::deque<Planning::OutboxEntry> _unsent; ///< Only while registered: what this connection has not been given yet.
    std::unordered_map<std::string, SentReport> _sent; ///< By transactionId.
    /// Sequences that the MCS has acknowledged and the engine may not have removed: its commands wait for the disk.
    std::set<std::uint64_t> _acknowledged;
    std::size_t _acknowledgedLimit = FIRST_ACKNOWLEDGED_LIMIT; ///< Then those that the engine has removed go.
    std::uint64_t _lastPublished =
        0;               ///< The highest sequence that is on disk: behind it the engine may know more already.
    bool _bOpen = false; ///< The replay has begun: what is told now goes behind it.
    bool _bReplaying = false;
    bool _bDraining = false;
    MessageStyle _style;
    AckObserver _ackObserver;
    RefusedReports _refusedReports;

public:
    /// Clock, engine and output must outlive the gateway.
    McsGateway(
        const Core::IClock& clock,
        Core::Logger logger,
        const Apps::LocalOffset& localOffset,
        const Planning::PlanEngine& engine,
        IMcsOutput& output,
        CommandHandler handler);

    /// Call once, before the engine is restored, with the highest report sequence of the store.
    void Restore(std::uint64_t lastSequence);

    /// From the next message on. Without it messages are as the document has them.
    void SetStyle(MessageStyle style);
    void SetAckObserver(AckObserver observer);

    /// From now on plans and controls are refused: acsd is about to stop.
    void BeginDraining();

    /// Call once, before the session starts. Sets the states of TSC and robots that the session reports.
    void Begin();

    /// Handles an event of the session.
    void OnSessionEvent(const Protocol::SessionEvent& event);

    void Reply(const Planning::ReplyCommand& reply);
    void Report(const Planning::OutboxEntry& entry);
    void PublishStatus(const Planning::RobotStatus& status);
    void PublishWorking(bool bWorking);
    void PublishTscState(Planning::ETscState state);

    [[nodiscard]] const RefusedReports& GetRefusedReports() const noexcept;

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
    void Acknowledge(std::uint64_t sequence);
    /// Forgets what the engine has removed from its outbox.
    void PruneAcknowledged(const std::vector<Planning::OutboxEntry>& outbox);
    void BeginReplay();
    void Feed();
    [[nodiscard]] std::chrono::minutes GetOffset() const;
};

} // namespace ACS::Acsd
