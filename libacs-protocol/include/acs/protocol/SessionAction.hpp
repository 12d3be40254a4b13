#pragma once

#include <acs/protocol/SessionEvent.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace ACS::Protocol
{

/// Timers of a session.
enum class ESessionTimer : std::uint8_t
{
    Registration, ///< ACS side: the Ack of Registration. MCS side: the earliest deadline of a Registration.
    Ack,          ///< The earliest deadline of an Ack.
    Reconnect,    ///< ACS side.
    Position,     ///< ACS side.
    Shutdown,     ///< ACS side.
    Answer,       ///< MCS side: the earliest deadline of an answer of the application.
};

/// Number of enumerators of ESessionTimer.
inline constexpr std::size_t TIMER_COUNT = 6;

/// Normal closure: a close code of RFC 6455, like the next two.
inline constexpr std::uint16_t CLOSE_NORMAL = 1000;
inline constexpr std::uint16_t CLOSE_ABNORMAL = 1006; ///< Never sent: the connection ends without a closing handshake.
inline constexpr std::uint16_t CLOSE_POLICY = 1008;   ///< Policy violation: the client was refused or replaced.

/// Send one unfragmented text message.
struct SendText
{
    ConnectionID connection = 0; ///< As OnConnected named it; 0 on the ACS side.
    std::string text;            ///< Valid UTF-8.
    bool bDroppable = false;     ///< May be dropped if the other side does not keep up (positions).

    bool operator==(const SendText&) const = default;
};

/// Open the connection, then call OnConnected or OnClosed.
struct Connect
{
    bool operator==(const Connect&) const = default;
};

/// Close the connection after everything that was sent before, or at once for CLOSE_ABNORMAL; then call OnClosed, once,
/// within a bounded time.
struct Close
{
    ConnectionID connection = 0;       ///< As OnConnected named it; 0 on the ACS side.
    std::uint16_t code = CLOSE_NORMAL; ///< Close code of RFC 6455.
    std::string reason;                ///< At most 123 bytes.

    bool operator==(const Close&) const = default;
};

/// Call OnTimer after the delay. Replaces a running timer of the same name.
struct StartTimer
{
    ESessionTimer timer = ESessionTimer::Ack; ///< To be passed to OnTimer.
    std::chrono::milliseconds delay{0};       ///< From the time that was passed to the call.

    bool operator==(const StartTimer&) const = default;
};

/// Do not call OnTimer for this timer. One that expires nevertheless is ignored.
struct CancelTimer
{
    ESessionTimer timer = ESessionTimer::Ack; ///< As in StartTimer.

    bool operator==(const CancelTimer&) const = default;
};

/// Pass the event to the user of the session.
struct Deliver
{
    SessionEvent event; ///< What has happened.

    bool operator==(const Deliver&) const = default;
};

/// To be carried out in order. Carrying an action out may call the session again; the actions of that call are appended.
using SessionAction = std::variant<SendText, Connect, Close, StartTimer, CancelTimer, Deliver>;
/// Actions of one or several calls; the caller clears and reuses it.
using SessionActions = std::vector<SessionAction>;

} // namespace ACS::Protocol
