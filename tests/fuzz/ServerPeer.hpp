#pragma once

#include "Choices.hpp"
#include <acs/openstream/OpenStreamCodec.hpp>
#include <acs/openstream/ServerSession.hpp>

#include <array>
#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Fuzz
{

/// The answers that a line may have; none of them where it is silent on success.
struct ExpectedAnswer
{
    std::vector<std::string> kinds; ///< The type of a line, or the code of an error.
    bool bMaySucceedSilently = false;
};

/// The connection, the service and the clock of a ServerSession. Checks: one send in flight, complete lines, answers in
/// the order of the commands and none lost, no data after a stop_ack, one CONTROL at the service, one close and nothing
/// after it.
class ServerPeer
{
    Core::Now _now{Core::SteadyTime{}, {}};
    OpenStream::ServerSession _session;
    OpenStream::ServerActions _actions;
    OpenStream::OpenStreamCodec _codec;
    std::array<std::optional<Core::SteadyTime>, OpenStream::SERVER_TIMER_COUNT> _deadlines;
    std::deque<ExpectedAnswer> _expected;
    std::vector<std::uint64_t> _asked; ///< Tokens of calls that are not answered.
    std::uint64_t _controlAsked = 0;   ///< The one of them that is a CONTROL.
    double _lastTs = -1.0;
    bool _bSending = false;
    bool _bStreaming = false; ///< A monitor_ack was sent, and no stop_ack after it.
    bool _bPaused = false;
    bool _bContinue = false;
    bool _bShutDown = false;
    bool _bPeerClosed = false;
    bool _bClosed = false;

public:
    explicit ServerPeer(const OpenStream::ServerSessionOptions& options);

    /// Expects the answers to the lines that end in these bytes. Does nothing while the session does not read.
    void Send(std::string_view bytes, const std::vector<ExpectedAnswer>& expected);
    void CompleteSend();
    void Answer(std::uint32_t choice, const OpenStream::ApiResponse& response);
    void Continue();
    void PassTime(std::chrono::milliseconds span);
    void ClosePeer();
    void BreakSocket();

    /// Completes everything that waits. Then no answer may be missing, and a peer that closes is closed within a
    /// second.
    void End();

    [[nodiscard]] bool IsReading() const;

private:
    void Execute();
    void Do(const OpenStream::ServerSend& action);
    void Do(const OpenStream::ServerCall& action);
    void Do(const OpenStream::ServerStopControl& action);
    void Do(const OpenStream::ServerStartTimer& action);
    void Do(const OpenStream::ServerCancelTimer& action);
    void Do(const OpenStream::ServerPauseReading& action);
    void Do(const OpenStream::ServerResumeReading& action);
    void Do(const OpenStream::ServerContinue& action);
    void Do(const OpenStream::ServerShutdownSend& action);
    void Do(const OpenStream::ServerClose& action);
    void CheckLine(std::string_view text);
    void CheckAnswer(const std::string& kind);
    void FireTimers();
};

} // namespace ACS::Fuzz
