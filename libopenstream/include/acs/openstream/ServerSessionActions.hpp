#pragma once

#include <acs/core/Now.hpp>
#include <acs/openstream/ApiRequest.hpp>
#include <acs/openstream/OpenStreamRequests.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <variant>
#include <vector>

namespace ACS::OpenStream
{

/// All times and limits of a server's session.
struct ServerSessionOptions
{
    std::chrono::milliseconds handshakeTimeout{5'000}; ///< No HANDSHAKE for so long: the end. 0: idleTimeout only.
    std::chrono::milliseconds idleTimeout{180'000};    ///< No MONITOR and no good command for so long: the end.
    std::chrono::milliseconds streamingTimeout{5'000}; ///< No data line left for so long after it was due: the end.
    std::chrono::milliseconds serviceTimeout{1'000};   ///< Of a call: beyond it a MONITOR reports an internal error.
    std::chrono::milliseconds controlBusyAfter{1'000}; ///< The queue of CONTROLs full for so long: control_busy.
    std::chrono::milliseconds closeTimeout{1'000};     ///< For the last lines to leave and the client to close.
    std::size_t longestLine = LONGEST_LINE;
    std::size_t maximumOutput = 1024U * 1024U; ///< Bytes of unsent lines, data apart; beyond it the session is closed.
    std::size_t maximumControls = 256;         ///< Waiting; beyond it the session stops reading.
    std::size_t maximumControlBytes = 4U * 1024U * 1024U; ///< Of those that wait; likewise.
    std::size_t commandsPerTurn = 64;                     ///< After so many lines a due tick may go first.
};

enum class EServerTimer : std::uint8_t
{
    MonitorTick,
    Watchdog, ///< Of the HANDSHAKE, then of an idle client, while streaming of interrupted streaming.
    ControlBusy,
    Close,
};

inline constexpr std::size_t SERVER_TIMER_COUNT = 4;

/// Why a server's session came to its end.
enum class EServerCloseReason : std::uint8_t
{
    PeerClosed,
    StopSession,
    HandshakeTimeout,
    IdleTimeout,
    StreamingTimeout,
    LineTooLong,
    OutputFull,
    Rejected,
    SocketError,
};

/// Write the text, then call OnSendCompleted. One is in flight at a time; the text is valid until that call.
struct ServerSend
{
    std::string_view text;
};

/// Ask the service, then call OnServiceAnswer with the token: at once, or later with a copy of the request, which is
/// valid only until the next event.
struct ServerCall
{
    std::uint64_t token = 0;
    const ApiRequest* request = nullptr; ///< Never null.
};

/// The client sent STOP control: tell the service.
struct ServerStopControl
{
};

/// Calls OnTimer at the deadline (of Now::steady); replaces the same timer.
struct ServerStartTimer
{
    EServerTimer timer = EServerTimer::MonitorTick;
    Core::SteadyTime deadline;
};

struct ServerCancelTimer
{
    EServerTimer timer = EServerTimer::MonitorTick;
};

/// Start no read until ServerResumeReading (TCP then slows the client down).
struct ServerPauseReading
{
};

struct ServerResumeReading
{
};

/// Call OnContinue soon, after timers that are due.
struct ServerContinue
{
};

/// Everything has left: shut down the sending side, keep reading until the client closes.
struct ServerShutdownSend
{
};

/// The last action: close the connection. No event may follow.
struct ServerClose
{
    EServerCloseReason reason = EServerCloseReason::PeerClosed;
};

using ServerAction = std::variant<
    ServerSend,
    ServerCall,
    ServerStopControl,
    ServerStartTimer,
    ServerCancelTimer,
    ServerPauseReading,
    ServerResumeReading,
    ServerContinue,
    ServerShutdownSend,
    ServerClose>;
using ServerActions = std::vector<ServerAction>;

/// What a session did, for metrics and for tests.
struct ServerSessionStats
{
    std::uint64_t dataLines = 0;     ///< Data lines that left.
    std::uint64_t replacedLines = 0; ///< Data lines that a newer one replaced before they left.
    std::uint64_t skippedTicks = 0;  ///< Ticks without a sample: the timer or the service was late, or it had none.
    std::uint64_t commands = 0;      ///< Good requests.
    std::uint64_t errorLines = 0;    ///< Error lines, control_err not counted.
    std::uint64_t controlErrors = 0; ///< control_err lines.

    bool operator==(const ServerSessionStats&) const = default;
    ServerSessionStats& operator+=(const ServerSessionStats& other) noexcept;
};

} // namespace ACS::OpenStream
