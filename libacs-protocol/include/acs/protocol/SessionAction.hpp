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

/// Which connection of a server; an AcsSession has one only and always says 0.
using ConnectionID = std::uint64_t;

enum class ESessionTimer : std::uint8_t
{
    Registration, ///< ACS side: the Ack of Registration. MCS side: the earliest Registration that has to come.
    Ack,          ///< The earliest deadline of what waits for an Ack.
    Reconnect,    ///< ACS side.
    Position,     ///< ACS side.
    Shutdown,     ///< ACS side.
    DelayedAck,   ///< MCS side: the earliest Ack that is held back (McsSession::HoldAcks).
};

inline constexpr std::size_t TIMER_COUNT = 6;

/// Close codes of RFC 6455 that the sessions use.
inline constexpr std::uint16_t CLOSE_NORMAL = 1000;
inline constexpr std::uint16_t CLOSE_POLICY = 1008;

/// Send one unfragmented text message.
struct SendText
{
    ConnectionID connection = 0;
    std::string text;
    bool bDroppable =
        false; ///< Leave it out where the other side does not keep up, so that it would come late (positions).

    bool operator==(const SendText&) const = default;
};

/// Open the connection; then report OnConnected or OnClosed.
struct Connect
{
    bool operator==(const Connect&) const = default;
};

/// Close the connection after what was sent before; then report OnClosed, once, within a bounded time.
struct Close
{
    ConnectionID connection = 0;
    std::uint16_t code = CLOSE_NORMAL;
    std::string reason; ///< At most 123 bytes.

    bool operator==(const Close&) const = default;
};

/// Call OnTimer after the delay. Replaces a timer of the same name that is running.
struct StartTimer
{
    ESessionTimer timer = ESessionTimer::Ack;
    std::chrono::milliseconds delay{0};

    bool operator==(const StartTimer&) const = default;
};

struct CancelTimer
{
    ESessionTimer timer = ESessionTimer::Ack;

    bool operator==(const CancelTimer&) const = default;
};

/// Give the event to the user of the session.
struct Deliver
{
    SessionEvent event;

    bool operator==(const Deliver&) const = default;
};

/// What a session wants done, in this order. Executing it may call the session again; what that returns comes after.
using SessionAction = std::variant<SendText, Connect, Close, StartTimer, CancelTimer, Deliver>;
using SessionActions = std::vector<SessionAction>;

} // namespace ACS::Protocol
