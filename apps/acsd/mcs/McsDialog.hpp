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

/// What acsd and the MCS say to each other: hands requests to the engine as commands, answers them, feeds the engine's
/// outbox into the session and tells the engine what was acknowledged. Pure: the session is the caller's.
class McsDialog final
{
public:
    /// Receives the engine's next command, as the last thing but what is told here: the engine may answer within the call,
    /// and whoever carries its actions out may call Reply, Report, TellStatus and TellTSC from it. Nothing else.
    using CommandHandler = std::function<void(Planning::PlanCommand command)>;
    /// Receives what the MCS answered to a report, and how long that took since this connection was given it.
    using AckObserver = std::function<void(const Protocol::Acked& acked, Core::Duration wait)>;

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
    std::uint64_t _lastTold = 0; ///< The highest sequence that is on disk: behind it the engine may know more already.
    bool _bOpen = false;         ///< The replay has begun: what is told now goes behind it.
    bool _bReplaying = false;
    bool _bDraining = false;
    MessageStyle _style;
    AckObserver _ackObserver;
    RefusedReports _refusedReports;

    void TakeRequest(const Protocol::AcsRequest& request);
    template <typename TList, typename TEntries>
    void AnswerList(
        const Protocol::AcsRequest& request,
        const std::string& message,
        TList list,
        TEntries TList::*entries);
    void LogAnswer(const OpenRequest& request, bool bAccepted, std::string_view reason);
    void AnswerQuery(const Protocol::AcsRequest& request);
    void AnswerHistory(const Protocol::AcsRequest& request, const Protocol::RequestAcsPlanHistory& query);
    void TakeAck(const Protocol::Acked& acked);
    void TakeRefusal(const Protocol::Acked& acked, const SentReport& sent);
    void Acknowledge(std::uint64_t sequence);
    /// Forgets what the engine has removed from its outbox.
    void PruneAcknowledged(const std::vector<Planning::OutboxEntry>& outbox);
    void BeginReplay();
    void Feed();
    [[nodiscard]] std::chrono::minutes GetOffset() const;

public:
    /// Clock, engine and output must outlive the dialog.
    McsDialog(
        const Core::IClock& clock,
        Core::Logger logger,
        const Apps::LocalOffset& localOffset,
        const Planning::PlanEngine& engine,
        IMcsOutput& output,
        CommandHandler handler);

    /// Once, before the engine is given what the store held: the highest sequence of a report in it.
    void Restore(std::uint64_t lastSequence);

    /// From the next message on. Without it messages are as the document has them.
    void SetStyle(MessageStyle style);
    void SetAckObserver(AckObserver observer);

    /// From now on plans and controls are refused: acsd is about to stop.
    void BeginDraining();

    /// Once, before the session is started: what the MCS is to be told of TSC and robots.
    void Begin();

    /// What the session tells.
    void OnSessionEvent(const Protocol::SessionEvent& event);

    void Reply(const Planning::ReplyCommand& reply);
    void Report(const Planning::OutboxEntry& entry);
    void TellStatus(const Planning::RobotStatus& status);
    void TellWorking(bool bWorking);
    void TellTSC(Planning::ETscState state);

    [[nodiscard]] const RefusedReports& GetRefusedReports() const noexcept;
};

} // namespace ACS::Acsd
