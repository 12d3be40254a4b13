#pragma once

#include "common/process/TimerSet.hpp"
#include "IAcsLink.hpp"
#include "judge/McsJudge.hpp"
#include "SimulatedACS.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/protocol_beast/AcsClient.hpp>
#include <acs/protocol_beast/ClientOptions.hpp>
#include <acs/protocol_beast/ISessionHandler.hpp>

#include <boost/asio/any_io_executor.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <string_view>

namespace ACS::AcsSim
{

/// Runs a SimulatedACS with an AcsClient and real time, prints what happens, and the table at the end. One thread: the
/// executor's.
class AcsRunner final : public ProtocolBeast::ISessionHandler, private IAcsLink
{
public:
    struct Options
    {
        ProtocolBeast::ClientOptions client;
        SimulatedACS::Options acs;
        std::chrono::milliseconds ackTimeout{5'000}; ///< Maximum time to an Ack.
        std::chrono::milliseconds duration{0};       ///< 0: no limit.
    };

    /// Called once, after the table was printed.
    using DoneHandler = std::function<void(int exitCode)>;

private:
    enum class ETimer : std::uint8_t
    {
        Tick, ///< Deadlines of the judge.
        Model,
        End,
    };

    boost::asio::any_io_executor _executor;
    const Core::IClock& _clock;
    Core::IRandom& _random;
    Core::Logger _logger;
    Options _options;
    std::ostream& _out;
    DoneHandler _onDone;
    McsJudge _judge;
    Apps::TimerSet<ETimer> _timers;
    std::unique_ptr<ProtocolBeast::AcsClient> _client;
    SimulatedACS _acs;
    bool _bStopping = false;

public:
    /// Clock, random source, log sink and output outlive the runner.
    AcsRunner(
        const boost::asio::any_io_executor& executor,
        const Core::IClock& clock,
        Core::IRandom& random,
        const Core::Logger& logger,
        Options options,
        std::ostream& out,
        DoneHandler onDone);

    /// Connects. The error concerns the URL, a header or a TLS file.
    [[nodiscard]] Core::Result<void> Start();
    /// Ends the run; harmless when it is ending already.
    void Stop() override;

    void OnSessionEvent(const Protocol::SessionEvent& event) override;

private:
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
    void SendText(const std::string& text) override;
    void Cut() override;

    [[nodiscard]] Core::Result<void> Connect();
    void OnTimer(ETimer timer);
    void ScheduleModel();
    void PrintNews();
    void Print(const std::string& line);
    void Finish();
};

} // namespace ACS::AcsSim
