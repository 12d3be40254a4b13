#pragma once

#include <acs/core/Api.hpp>
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

/// Times and limits of a ServerSession.
struct ServerSessionOptions
{
    std::chrono::milliseconds handshakeTimeout{5'000}; ///< Maximum time until HANDSHAKE; 0: idleTimeout applies.
    std::chrono::milliseconds idleTimeout{180'000};    ///< Maximum time without a MONITOR or a valid command.
    std::chrono::milliseconds streamingTimeout{5'000}; ///< Maximum delay of a data line.
    std::chrono::milliseconds serviceTimeout{1'000};   ///< Of a call; a MONITOR then reports an internal error.
    std::chrono::milliseconds controlBusyAfter{1'000}; ///< Full queue of CONTROLs for this time: control_busy.
    std::chrono::milliseconds closeTimeout{1'000};     ///< To send the last lines and for the client to close.
    std::size_t longestLine = LONGEST_LINE;            ///< Bytes of a received line; a longer one ends the session.
    std::size_t maximumOutput = 1024U * 1024U;         ///< Unsent bytes (without data) above which the session closes.
    std::size_t maximumControls = 256;                 ///< Queued CONTROLs; if full, the session stops reading.
    std::size_t maximumControlBytes = 4U * 1024U * 1024U; ///< Memory of all queued CONTROLs; likewise.
    std::size_t commandsPerTurn = 64;                     ///< Lines processed before a due timer is served.
};

/// Timers of a ServerSession.
enum class EServerTimer : std::uint8_t
{
    MonitorTick, ///< The next sample is due.
    Watchdog,    ///< handshakeTimeout, idleTimeout or streamingTimeout.
    ControlBusy, ///< controlBusyAfter.
    Close,       ///< closeTimeout.
};

/// Number of enumerators of EServerTimer.
inline constexpr std::size_t SERVER_TIMER_COUNT = 4;

/// Why a session ended.
enum class EServerCloseReason : std::uint8_t
{
    PeerClosed,       ///< The client closed the connection.
    StopSession,      ///< The client sent STOP session.
    HandshakeTimeout, ///< ServerSessionOptions::handshakeTimeout.
    IdleTimeout,      ///< ServerSessionOptions::idleTimeout.
    StreamingTimeout, ///< ServerSessionOptions::streamingTimeout.
    LineTooLong,      ///< ServerSessionOptions::longestLine.
    OutputFull,       ///< ServerSessionOptions::maximumOutput.
    Rejected,         ///< ServerSession::Reject.
    SocketError,      ///< OnSocketError.
};

/// Write the text, then call OnSendCompleted. One is in flight at a time; the text is valid until that call.
struct ServerSend
{
    std::string_view text; ///< One or more whole lines.
};

/// Call the service, then call OnServiceAnswer with the token: at once, or later with a copy of the request, which is valid
/// only until the next event.
struct ServerCall
{
    std::uint64_t token = 0;             ///< To be passed to OnServiceAnswer.
    const ApiRequest* request = nullptr; ///< Never null.
};

/// The client sent STOP control: call IOpenApiService::StopControl, unless bControls is false and ServerSession::HasControl
/// of another session of this controller is true.
struct ServerStopControl
{
    /// Whether this session received a CONTROL since HANDSHAKE or its last STOP control. If not, the client is answered with
    /// nothing_to_stop, but a lost connection or a client over HTTP may have left a motion that it wants to stop.
    bool bControls = true;
};

/// Call OnTimer at the deadline (of Now::steady). Replaces a running timer of the same name.
struct ServerStartTimer
{
    EServerTimer timer = EServerTimer::MonitorTick;
    Core::SteadyTime deadline;
};

/// Do not call OnTimer for this timer.
struct ServerCancelTimer
{
    EServerTimer timer = EServerTimer::MonitorTick;
};

/// Stop reading until ServerResumeReading (TCP then slows the client down).
struct ServerPauseReading
{
};

/// Continue to read after ServerPauseReading.
struct ServerResumeReading
{
};

/// Call OnContinue soon, after timers that are due.
struct ServerContinue
{
};

/// Everything was sent: shut down the sending side, and keep reading until the client closes.
struct ServerShutdownSend
{
};

/// The last action: close the connection. No event may follow.
struct ServerClose
{
    EServerCloseReason reason = EServerCloseReason::PeerClosed; ///< For the log.
};

/// What the caller of a ServerSession carries out.
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
/// To be carried out in order, before the next event.
using ServerActions = std::vector<ServerAction>;

/// Counters of a session.
struct ACS_API ServerSessionStats
{
    std::uint64_t dataLines = 0;     ///< Data lines that were sent.
    std::uint64_t replacedLines = 0; ///< Data lines that a newer one replaced before they were sent.
    std::uint64_t skippedTicks = 0;  ///< Periods without a sample: late timer or service, or no data.
    std::uint64_t commands = 0;      ///< Valid requests.
    std::uint64_t errorLines = 0;    ///< Error lines, without control_err.
    std::uint64_t controlErrors = 0; ///< control_err lines.

    bool operator==(const ServerSessionStats&) const = default;
    /// Adds each counter, for totals over sessions.
    ServerSessionStats& operator+=(const ServerSessionStats& other) noexcept;
};

} // namespace ACS::OpenStream
