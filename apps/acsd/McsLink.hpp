#pragma once

#include "AcsdConfig.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/plan/PlanCommand.hpp>
#include <acs/plan/PlanEngine.hpp>
#include <acs/plan/Report.hpp>
#include <acs/plan/RobotStatus.hpp>
#include <acs/protocol_beast/AcsClient.hpp>
#include <acs/protocol_beast/ISessionHandler.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <unordered_map>

namespace ACS::Acsd
{

/// The side of acsd that faces the MCS: hands requests to the engine as commands, answers them, feeds the engine's
/// outbox into the session and tells the engine what was acknowledged. One thread: the executor's.
class McsLink final : private ProtocolBeast::ISessionHandler
{
public:
    /// Receives the engine's next command; must not call the link.
    using CommandHandler = std::function<void(Planning::PlanCommand command)>;
    using StopHandler = std::function<void()>;

private:
    /// A command of the MCS that waits for the engine's reply.
    struct OpenRequest
    {
        Protocol::EAcsCommand command = Protocol::EAcsCommand::ExecutionPlan;
        std::string transactionID;
        std::string planID;
    };

    const Core::IClock& _clock;
    Core::Logger _logger;
    Apps::LocalOffset _localOffset;
    const Planning::PlanEngine& _engine;
    CommandHandler _handler;
    StopHandler _stopHandler;
    std::unique_ptr<ProtocolBeast::AcsClient> _client;
    std::map<Planning::ReplyToken, OpenRequest> _openRequests;
    Planning::ReplyToken _lastToken = 0;
    std::deque<Planning::OutboxEntry> _unsent; ///< Only while registered: what this connection has not been given yet.
    std::unordered_map<std::string, std::uint64_t> _sequences; ///< By transactionId, of what was given to the session.
    bool _bReplaying = false;
    std::string _url;
    std::string _loggedOutage; ///< The reason that was told last, of the outage that goes on.

    void OnSessionEvent(const Protocol::SessionEvent& event) override;
    void LogNote(const Protocol::ProtocolNoted& noted);
    void LogOutage(const Protocol::LinkLost& lost);
    void TakeRequest(const Protocol::AcsRequest& request);
    void AnswerQuery(const Protocol::AcsRequest& request);
    void AnswerHistory(const Protocol::AcsRequest& request, const Protocol::RequestAcsPlanHistory& query);
    void TakeAck(const Protocol::Acked& acked);
    void BeginReplay();
    void Feed();
    [[nodiscard]] std::chrono::minutes GetOffset() const;

public:
    /// Clock and engine must outlive the link.
    McsLink(
        const Core::IClock& clock,
        Core::Logger logger,
        const Apps::LocalOffset& localOffset,
        const Planning::PlanEngine& engine,
        CommandHandler handler);
    McsLink(const McsLink&) = delete;
    McsLink& operator=(const McsLink&) = delete;
    ~McsLink() override;

    /// Once, before everything else. Fails with a sentence about the URL; opens no connection.
    [[nodiscard]] Core::Result<void> Open(
        const boost::asio::any_io_executor& executor,
        Core::IRandom& random,
        const AcsdConfig& config);
    void Start();

    /// Tells the MCS, takes leave of it, then calls back.
    void StopAsync(StopHandler handler);

    void Reply(const Planning::ReplyCommand& reply);
    void Report(const Planning::OutboxEntry& entry);
    void TellStatus(const Planning::RobotStatus& status);
    void TellWorking(bool bWorking);
    void TellTsc(Planning::ETscState state);

    [[nodiscard]] bool IsRegistered() const;
    [[nodiscard]] const Protocol::SessionStatistics& GetStatistics() const;
};

} // namespace ACS::Acsd
