#pragma once

#include <acs/core/Backoff.hpp>
#include <acs/core/JsonText.hpp>
#include <acs/core/Now.hpp>
#include <acs/openstream/OpenStreamLines.hpp>
#include <acs/openstream/OpenStreamRequests.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace ACS::OpenStream
{

/// All times and limits of a client's session. A time of 0 switches off what its comment says.
struct ClientSessionOptions
{
    std::chrono::milliseconds connectTimeout{3'000};
    std::chrono::milliseconds answerTimeout{2'000}; ///< For the ack of HANDSHAKE, MONITOR and STOP.
    std::chrono::milliseconds controlWindow{500};   ///< Silence for so long after a CONTROL left means that it worked.
    std::chrono::milliseconds staleAfter{500};      ///< Data overdue for so long: MonitorStale. 0: never.
    std::chrono::milliseconds lostAfter{3'000};     ///< Data overdue for so long: reconnect. 0: never.
    Core::BackoffOptions reconnect;
    /// A CONTROL or a STOP control that has not left for so long: where it is tracked and waits for its turn, NotSent; where
    /// the socket does not take it, the connection is given up, so that it cannot leave later. 0: waits for ever.
    std::chrono::milliseconds controlTimeout{5'000};
    bool bSampleEvents = true; ///< Every sample as ClientData. Off, only GetLatestOrNull shows them, the newest one.
    std::size_t longestLine = LONGEST_LINE;
    std::size_t maximumControls = 64;          ///< Waiting for their turn.
    std::size_t maximumOutput = 1024U * 1024U; ///< Bytes unsent, beyond which a CONTROL is not taken.
};

enum class EClientTimer : std::uint8_t
{
    Connect,
    Answer, ///< To the command in flight, or the end of a CONTROL's window.
    DataAge,
    Retry,
    Control, ///< CONTROLs that do not leave, confirmations that do not come.
};

inline constexpr std::size_t CLIENT_TIMER_COUNT = 5;

/// How a CONTROL is sent.
enum class EControlTracking : std::uint8_t
{
    Tracked,  ///< One at a time, each with an outcome.
    Streamed, ///< At once, between others, with no outcome but ClientControlFault. For points at a short period.
};

/// A CONTROL, and what its outcome depends on.
struct ControlCall
{
    ControlRequest request;
    EControlTracking tracking = EControlTracking::Tracked;
    /// For this one in place of ClientSessionOptions::controlTimeout; 0: that.
    std::chrono::milliseconds timeout{0};
    /// Tracked: what a sample must show that comes after the CONTROL has left, or else silence is no success. Called for
    /// each sample, on the session's thread, from within the session, and must not call it.
    std::function<bool(const DataLine& sample)> isConfirmed;
    std::chrono::milliseconds confirmWithin{1'000}; ///< Of having left. The window passes in any case.
};

enum class EControlOutcome : std::uint8_t
{
    Accepted, ///< No refusal came within the window, and a sample confirmed it where that was asked for.
    Refused,  ///< A control_err or an error line came; whether it was this one's, see ClientSession.
    Unknown,  ///< It left, or partly left, and the connection was lost within the window or before it was confirmed.
    NotSent,  ///< It surely never left: no session, queue full, too late, or the connection was lost before its turn.
    Unconfirmed, ///< No refusal came, but no sample confirmed it in time.
};

enum class EClientLossReason : std::uint8_t
{
    ConnectFailed,
    ConnectTimeout,
    AnswerTimeout,   ///< No ack in time.
    HandshakeFailed, ///< The server refused: another version, no room, …
    PeerClosed,
    SocketError,
    SessionEnded, ///< An error line that ends the session, such as session_timeout.
    DataSilent,   ///< ClientSessionOptions::lostAfter.
    SendTimeout,  ///< The socket did not take a CONTROL in time.
    LineTooLong,
};

/// Connect; then OnConnected or OnConnectFailed.
struct ClientConnect
{
};

/// Write the text, then call OnSendCompleted. One is in flight at a time; the text is valid until that call or until
/// ClientClose.
struct ClientSend
{
    std::string_view text;
};

/// Close the connection, or give up connecting. No event of it may follow.
struct ClientClose
{
};

/// Calls OnTimer at the deadline (of Now::steady); replaces the same timer.
struct ClientStartTimer
{
    EClientTimer timer = EClientTimer::Connect;
    Core::SteadyTime deadline;
};

struct ClientCancelTimer
{
    EClientTimer timer = EClientTimer::Connect;
};

/// Event: the handshake is done. The MONITOR is being established again, CONTROLs are taken.
struct ClientReady
{
    std::string version; ///< Of the server; may be empty.
};

/// Event: the server took the MONITOR.
struct ClientMonitorStarted
{
    std::uint64_t requestNumber = 0; ///< Of the SetMonitor call that it was sent for; another one may have followed.
};

/// Event: the server refused the MONITOR. It is tried again after SetMonitor or a reconnect.
struct ClientMonitorRefused
{
    ErrorLine error;
    std::string url; ///< Of the MONITOR that was refused; SetMonitor may have asked for another one since.
};

/// Event: a sample.
struct ClientData
{
    DataLine line;
    Core::Now receivedAt;
};

/// Event, once an episode: the MONITOR is active and its data is overdue.
struct ClientMonitorStale
{
    std::chrono::milliseconds age{}; ///< Since the last sample or the start.
};

/// Event: what became of a tracked CONTROL. Every token comes exactly once.
struct ClientControlSettled
{
    std::uint64_t token = 0;
    EControlOutcome outcome = EControlOutcome::Unknown;
    int status = 0;                     ///< HTTP, where refused.
    std::optional<Core::JsonText> body; ///< Of the refusal.
    std::string detail;                 ///< For people; empty where accepted.
};

/// Event: a refusal while no tracked CONTROL was in flight: a streamed one's, or one that came after the window.
struct ClientControlFault
{
    int status = 0;
    std::optional<Core::JsonText> body;
    std::string detail;
};

/// Event: a STOP was acknowledged, or there was nothing to stop.
struct ClientStopped
{
    EStopTarget target = EStopTarget::Monitor;
};

/// Event: an error line that belongs to none of the above (monitor_internal_error, invalid_ndjson …).
struct ClientErrorReported
{
    ErrorLine error;
};

/// Event: a line that is none. It was skipped.
struct ClientBadLine
{
    std::string detail;
};

/// Event: the connection is gone, or could not be made. The session tries again by itself.
struct ClientLost
{
    EClientLossReason reason = EClientLossReason::SocketError;
    std::string detail;
    std::chrono::milliseconds retryIn{};
};

/// Event: as asked for by Stop. The last one.
struct ClientEnded
{
};

using ClientEvent = std::variant<
    ClientReady,
    ClientMonitorStarted,
    ClientMonitorRefused,
    ClientData,
    ClientMonitorStale,
    ClientControlSettled,
    ClientControlFault,
    ClientStopped,
    ClientErrorReported,
    ClientBadLine,
    ClientLost,
    ClientEnded>;

using ClientAction =
    std::variant<ClientConnect, ClientSend, ClientClose, ClientStartTimer, ClientCancelTimer, ClientEvent>;
using ClientActions = std::vector<ClientAction>;

/// Figures of the MONITOR, since the session was made.
struct ClientSessionStats
{
    std::uint64_t dataLines = 0;
    std::uint64_t missingLines = 0; ///< Periods that `ts` skipped.
    std::uint64_t badLines = 0;
    std::uint64_t connects = 0; ///< Successful handshakes.

    bool operator==(const ClientSessionStats&) const = default;
};

} // namespace ACS::OpenStream
