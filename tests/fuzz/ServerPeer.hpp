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

/// What a line that was sent may be answered with; none of them, where it is silent on success.
struct ExpectedAnswer
{
    std::vector<std::string> kinds; ///< The type of a line, or the code of an error.
    bool bMaySucceedSilently = false;
};

/// The connection, the service and the clock of a ServerSession. Holds it to: one send in flight, whole lines, answers in
/// the order of the commands and none lost, no data after a stop_ack, one CONTROL at the service, one close and nothing
/// behind it.
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
    bool _bStreaming = false; ///< A monitor_ack came and no stop_ack behind it.
    bool _bPaused = false;
    bool _bContinue = false;
    bool _bShutDown = false;
    bool _bPeerClosed = false;
    bool _bClosed = false;

public:
    explicit ServerPeer(const OpenStream::ServerSessionOptions& options);

    /// The expectations are those of the lines that end in these bytes. Nothing while the session does not read.
    void Send(std::string_view bytes, const std::vector<ExpectedAnswer>& expected);
    void CompleteSend();
    void Answer(std::uint32_t choice, const OpenStream::ApiResponse& response);
    void Continue();
    void PassTime(std::chrono::milliseconds span);
    void ClosePeer();
    void BreakSocket();

    /// Everything that waits is let go; then nothing may be owed, and a peer that closes is closed within a second.
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
