#pragma once

#include "common/log/LogRateLimiter.hpp"
#include "config/AcsdConfig.hpp"
#include "mcs/IMcsOutput.hpp"
#include "mcs/McsDialog.hpp"
#include "mcs/McsNoteLog.hpp"
#include "mcs/RegistrationWatch.hpp"
#include "operator/AcsdStatus.hpp"
#include "trace/MessageTrace.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/plan/PlanEngine.hpp>
#include <acs/plan/Report.hpp>
#include <acs/plan/RobotStatus.hpp>
#include <acs/protocol_beast/AcsClient.hpp>
#include <acs/protocol_beast/ISessionHandler.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <initializer_list>
#include <memory>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// The side of acsd that faces the MCS: a McsDialog over a WebSocket, and what is logged of it. One thread: the executor's.
class McsLink final : private ProtocolBeast::ISessionHandler, private IMcsOutput
{
public:
    using CommandHandler = McsDialog::CommandHandler;
    using StopHandler = std::function<void()>;

    /// What the session's own statistics do not have.
    struct Figures
    {
        bool bConnected = false;
        std::size_t longestSent = 0; ///< Bytes of the longest text that was sent.
        std::uint64_t unanswered = 0;
        std::array<std::uint64_t, Protocol::COMMAND_COUNT> refused{}; ///< Own reports, by the MCS.
        RefusedReports refusedReports;
    };
    /// Receives the wait for each acknowledgement of a report.
    using AckObserver = std::function<void(Core::Duration wait)>;

private:
    const Core::IClock& _clock;
    Core::Logger _logger;
    Apps::LogRateLimiter _log; ///< For what the MCS can make come in a flood.
    McsNoteLog _notes;
    RegistrationWatch _watch;
    McsDialog _dialog;
    StopHandler _stopHandler;
    std::unique_ptr<ProtocolBeast::AcsClient> _client;
    std::string _url;
    Figures _figures;
    std::uint64_t _connectsBefore = 0; ///< When the last connection was lost, or could not be made.
    AckObserver _ackObserver;
    std::size_t _warnBytes = 0;
    MessageTrace* _traceOrNull = nullptr;
    std::string _loggedOutage; ///< The reason that was told last, of the outage that goes on.

    void OnSessionEvent(const Protocol::SessionEvent& event) override;
    void LogEvent(const Protocol::SessionEvent& event);
    void Warn(std::string_view kind, std::string_view message, std::initializer_list<Core::LogField> fields);
    void WatchWire(ProtocolBeast::EWireDirection direction, std::string_view text);
    void LogOutage(const Protocol::LinkLost& lost);

    [[nodiscard]] bool TrySendDurable(const Protocol::AcsRequest& request) override;
    void ReplayDone() override;
    void SendStatus(const Protocol::AcsPayload& status) override;
    void SendPosition(const Protocol::RobotPositionUpdate& positions) override;
    void Answer(
        Protocol::EAcsCommand command,
        std::string_view transactionID,
        Protocol::EAckResult result,
        std::string_view message,
        const Protocol::AckPayload& payload) override;
    void SetSiteOffset(std::chrono::minutes offset) override;

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

    /// Once, before everything else. Fails with a sentence about the URL; opens no connection. A trace outlives the link.
    [[nodiscard]] Core::Result<void> Open(
        const boost::asio::any_io_executor& executor,
        Core::IRandom& random,
        const AcsdConfig& config,
        MessageTrace* traceOrNull);

    /// Once, before the engine is given what the store held: the highest sequence of a report in it.
    void Restore(std::uint64_t lastSequence);
    void Start();

    /// What of the configuration may change while acsd runs (see LiveConfig).
    void SetLimits(const McsConfig& config);
    void SetAckObserver(AckObserver observer);

    /// From now on plans and controls are refused, and the MCS is told that no work is taken.
    void BeginDraining();

    /// Tells the MCS, takes leave of it, then calls back.
    void StopAsync(StopHandler handler);

    void Reply(const Planning::ReplyCommand& reply);
    void Report(const Planning::OutboxEntry& entry);
    void TellStatus(const Planning::RobotStatus& status);
    void TellWorking(bool bWorking);
    void TellTSC(Planning::ETscState state);

    [[nodiscard]] bool IsRegistered() const override;
    [[nodiscard]] const Protocol::SessionStatistics& GetStatistics() const;
    [[nodiscard]] Figures GetFigures() const;
    /// Up while it is registered.
    [[nodiscard]] LinkStatus GetLink() const;
};

} // namespace ACS::Acsd
