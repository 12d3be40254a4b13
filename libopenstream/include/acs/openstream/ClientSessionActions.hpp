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

/// Times and limits of a ClientSession.
struct ClientSessionOptions
{
    std::chrono::milliseconds connectTimeout{3'000}; ///< Maximum time to connect, name resolution included.
    std::chrono::milliseconds answerTimeout{
        2'000};                                   ///< Maximum time to wait for the ack of HANDSHAKE, MONITOR and STOP.
    std::chrono::milliseconds controlWindow{500}; ///< A CONTROL without a refusal within this time has succeeded.
    std::chrono::milliseconds staleAfter{500};    ///< Delay of data that is reported as stale; 0 disables.
    std::chrono::milliseconds lostAfter{3'000};   ///< Delay of data that causes a reconnect; 0 disables.
    Core::BackoffOptions reconnect;               ///< Delays between connection attempts.
    /// Maximum time until a CONTROL or STOP control is sent. A queued tracked one is then settled as NotSent; if the socket
    /// does not accept it, the connection is closed, so that it cannot be sent later. 0: no limit.
    std::chrono::milliseconds controlTimeout{5'000};
    bool bSampleEvents =
        true; ///< Report every sample as ClientData; otherwise only GetLatestOrNull has the newest one.
    std::size_t longestLine = LONGEST_LINE;    ///< Bytes of a received line; a longer one ends the connection.
    std::size_t maximumControls = 64;          ///< Maximum number of queued CONTROLs.
    std::size_t maximumOutput = 1024U * 1024U; ///< Unsent bytes above which a CONTROL is not accepted.
};

/// Timers of a ClientSession.
enum class EClientTimer : std::uint8_t
{
    Connect, ///< Deadline of the connection attempt.
    Answer,  ///< Deadline of the command in flight, or end of a CONTROL's window.
    DataAge, ///< The data of the MONITOR becomes stale or lost.
    Retry,   ///< The next connection attempt.
    Control, ///< Deadlines for sending and confirming CONTROLs.
};

/// Number of enumerators of EClientTimer.
inline constexpr std::size_t CLIENT_TIMER_COUNT = 5;

/// How a CONTROL is sent.
enum class EControlTracking : std::uint8_t
{
    Tracked,  ///< One at a time, each with an outcome.
    Streamed, ///< Sent at once, without an outcome except ClientControlFault. For points at a short period.
};

/// A CONTROL with its time limit and confirmation.
struct ControlCall
{
    ControlRequest request; ///< What is called at the controller.
    /// timeout applies to both kinds, the confirmation to a tracked one only.
    EControlTracking tracking = EControlTracking::Tracked;
    /// Replaces ClientSessionOptions::controlTimeout; 0: use that.
    std::chrono::milliseconds timeout{0};
    /// Tracked only: if set, the CONTROL succeeds only if a later sample satisfies this predicate. Called by the session for
    /// each sample; must not call the session.
    std::function<bool(const DataLine& sample)> isConfirmed;
    std::chrono::milliseconds confirmWithin{1'000}; ///< After it was sent; at least the window.
};

/// What became of a tracked CONTROL. The protocol has no positive answer.
enum class EControlOutcome : std::uint8_t
{
    Accepted,    ///< No refusal within the window, and confirmed by a sample if a confirmation was requested.
    Refused,     ///< A control_err or an error line was received; for the match see ClientSession.
    Unknown,     ///< Sent at least partly; the connection was lost within the window or before the confirmation.
    NotSent,     ///< Certainly not sent: no session, queue full, time limit, or connection lost before its turn.
    Unconfirmed, ///< No refusal, but no confirmation in time.
};

/// Why a connection ended or was not opened.
enum class EClientLossReason : std::uint8_t
{
    ConnectFailed,   ///< OnConnectFailed.
    ConnectTimeout,  ///< ClientSessionOptions::connectTimeout.
    AnswerTimeout,   ///< No ack in time.
    HandshakeFailed, ///< The server refused: another version, no room, …
    PeerClosed,      ///< OnPeerClosed.
    SocketError,     ///< OnSocketError.
    SessionEnded,    ///< An error line that ends the session, such as session_timeout.
    DataSilent,      ///< ClientSessionOptions::lostAfter.
    SendTimeout,     ///< The socket did not accept a CONTROL in time.
    LineTooLong,     ///< ClientSessionOptions::longestLine.
};

/// Connect, then call OnConnected or OnConnectFailed.
struct ClientConnect
{
};

/// Write the text, then call OnSendCompleted. One is in flight at a time; the text is valid until that call or until
/// ClientClose.
struct ClientSend
{
    std::string_view text; ///< One or more whole lines.
};

/// Close the connection, or cancel the connection attempt. No event of it may follow.
struct ClientClose
{
};

/// Call OnTimer at the deadline (of Now::steady). Replaces a running timer of the same name.
struct ClientStartTimer
{
    EClientTimer timer = EClientTimer::Connect;
    Core::SteadyTime deadline;
};

/// Do not call OnTimer for this timer.
struct ClientCancelTimer
{
    EClientTimer timer = EClientTimer::Connect;
};

/// Event: the handshake succeeded. The MONITOR is established again, and CONTROLs are accepted.
struct ClientReady
{
    std::string version; ///< Of the server; may be empty.
};

/// Event: the server accepted the MONITOR.
struct ClientMonitorStarted
{
    std::uint64_t requestNumber = 0; ///< Number of its SetMonitor call; later calls may have followed.
};

/// Event: the server refused the MONITOR. It is sent again after SetMonitor or a reconnect. ClientMonitorStarted may follow if
/// the refusal was of a streamed CONTROL.
struct ClientMonitorRefused
{
    ErrorLine error; ///< As received.
    std::string url; ///< Of the refused MONITOR; SetMonitor may have set another one since.
};

/// Event: a sample.
struct ClientData
{
    DataLine line;        ///< As received.
    Core::Now receivedAt; ///< The time of the call of OnBytes.
};

/// Event: the MONITOR is active and its data is overdue. Reported once until data arrives again.
struct ClientMonitorStale
{
    std::chrono::milliseconds age{}; ///< Since the last sample or the start.
};

/// Event: the outcome of a tracked CONTROL. Reported exactly once per token.
struct ClientControlSettled
{
    std::uint64_t token = 0;                            ///< As SendControl or SendControlCall returned it.
    EControlOutcome outcome = EControlOutcome::Unknown; ///< Whether the controller has executed the call.
    int status = 0;                                     ///< HTTP status if refused.
    std::optional<Core::JsonText> body;                 ///< Of the refusal.
    std::string detail;                                 ///< For the operator; empty if accepted.
};

/// Event: a refusal while no tracked CONTROL was in flight: of a streamed one, of one that STOP control has settled, or after
/// the window. Also a streamed CONTROL that was not sent.
struct ClientControlFault
{
    int status =
        0; ///< HTTP status of the refusal, of an error line that of its code; 0: a streamed CONTROL was not sent.
    std::optional<Core::JsonText> body; ///< Of the refusal; none of an error line.
    std::string detail;                 ///< For the operator.
};

/// Event: a STOP was acknowledged, or there was nothing to stop. In the latter case the motion that another session controls
/// continues.
struct ClientStopped
{
    EStopTarget target = EStopTarget::Monitor; ///< What was stopped.
};

/// Event: any other error line (monitor_internal_error, invalid_ndjson …).
struct ClientErrorReported
{
    ErrorLine error; ///< As received.
};

/// Event: an invalid line, which was skipped.
struct ClientBadLine
{
    std::string detail; ///< What is invalid, for the log.
};

/// Event: the connection was lost or could not be opened. The session reconnects by itself.
struct ClientLost
{
    EClientLossReason reason = EClientLossReason::SocketError; ///< For a decision of the program.
    std::string detail;                                        ///< For the log.
    std::chrono::milliseconds retryIn{};                       ///< Delay before the next connection attempt.
};

/// Event: Stop is complete. The last event.
struct ClientEnded
{
};

/// What a ClientSession reports to its user.
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

/// What the caller of a ClientSession carries out; a ClientEvent is passed to the user.
using ClientAction =
    std::variant<ClientConnect, ClientSend, ClientClose, ClientStartTimer, ClientCancelTimer, ClientEvent>;
/// To be carried out in order, before the next event.
using ClientActions = std::vector<ClientAction>;

/// Counters since the session was created.
struct ClientSessionStats
{
    std::uint64_t dataLines = 0;    ///< Samples of all MONITORs.
    std::uint64_t missingLines = 0; ///< Periods without a sample, according to `ts`.
    std::uint64_t badLines = 0;     ///< Invalid lines, which were skipped.
    std::uint64_t connects = 0;     ///< Successful handshakes.

    bool operator==(const ClientSessionStats&) const = default;
};

} // namespace ACS::OpenStream
