#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Now.hpp>
#include <acs/openstream/ApiRequest.hpp>
#include <acs/openstream/ServerSessionActions.hpp>

#include <cstdint>
#include <memory>
#include <string_view>

namespace ACS::OpenStream
{

/// How far a ServerSession is.
enum class EServerState : std::uint8_t
{
    Connected, ///< Waits for HANDSHAKE.
    Ready,     ///< The handshake succeeded; no MONITOR is active.
    Streaming, ///< A MONITOR is active.
    Closing,   ///< The last lines are sent; commands are answered with handshake_required.
    Closed,    ///< ServerClose was requested.
};

/// The controller side of one Open Stream connection, without I/O: events and the time go in, actions come out, appended
/// to a vector that the caller reuses. The caller carries out each batch of actions, in order, before the next event;
/// events that result from them (OnServiceAnswer, OnSendCompleted) append to the same batch. "→" lists the actions that a
/// function may append.
class ACS_API ServerSession
{
    class ACS_HIDDEN Impl;
    std::unique_ptr<Impl> _impl;

public:
    /// Sends nothing before Start.
    explicit ServerSession(const ServerSessionOptions& options = {});
    ServerSession(const ServerSession&) = delete;
    ServerSession& operator=(const ServerSession&) = delete;
    ~ServerSession();

    /// The connection was accepted. → StartTimer.
    void Start(Core::Now now, ServerActions& out);

    /// Rejects an accepted connection (no room, replaced by another client, or shutdown of the server): sends
    /// handshake_rejected, then closes. → Send, StartTimer, CancelTimer.
    void Reject(std::string_view message, Core::Now now, ServerActions& out);

    /// → any action.
    void OnBytes(std::string_view bytes, Core::Now now, ServerActions& out);

    /// Requested by ServerContinue. → any action.
    void OnContinue(Core::Now now, ServerActions& out);

    /// Requested by ServerStartTimer. → Send, Call, timers, Close.
    void OnTimer(EServerTimer timer, Core::Now now, ServerActions& out);

    /// The answer to a ServerCall; an outdated one is ignored. → Send, Call, timers, ResumeReading.
    void OnServiceAnswer(std::uint64_t token, const ApiResponse& response, Core::Now now, ServerActions& out);

    /// The text of the last ServerSend was written. → Send, ShutdownSend, Close.
    void OnSendCompleted(Core::Now now, ServerActions& out);

    /// The client closed its sending side. → Send, timers, Close.
    void OnPeerClosed(Core::Now now, ServerActions& out);

    /// The connection was lost. → CancelTimer, Close.
    void OnSocketError(ServerActions& out);

    /// After the last call.
    [[nodiscard]] EServerState GetState() const noexcept;
    /// Whether this session controls the robot: it is open, and received a CONTROL since HANDSHAKE or its last STOP control.
    /// See ServerStopControl.
    [[nodiscard]] bool HasControl() const noexcept;
    /// Counters since the session was created.
    [[nodiscard]] const ServerSessionStats& GetStats() const noexcept;
};

} // namespace ACS::OpenStream
