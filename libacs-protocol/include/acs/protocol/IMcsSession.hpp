#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Now.hpp>
#include <acs/protocol/AcsMessage.hpp>
#include <acs/protocol/SessionAction.hpp>
#include <acs/protocol/SessionStatistics.hpp>

#include <cstddef>
#include <optional>
#include <string_view>

namespace ACS::Protocol
{

/// The MCS side of the protocol as a server drives it: McsSession, or a decorator around one (a simulated MCS that
/// loses Acks, for example). Not shared between threads. Calls append to out: move the actions out of it before carrying
/// them out.
class ACS_API IMcsSession
{
public:
    IMcsSession() = default;
    IMcsSession(const IMcsSession&) = delete;
    IMcsSession& operator=(const IMcsSession&) = delete;
    virtual ~IMcsSession() = default;

    /// Whether a WebSocket upgrade is refused with 403 now (option bSecondRefused, and a client is connected).
    [[nodiscard]] virtual bool ShouldRefuseUpgrade() const noexcept = 0;

    /// A client has connected: StartTimer. The caller assigns the id and never reuses one.
    virtual void OnConnected(ConnectionID connection, Core::Now now, SessionActions& out) = 0;

    /// SendText (Acks), Close (a connection that is replaced, or the second one where that is refused), CancelTimer,
    /// StartTimer, Deliver of Registered, LinkLost, RequestReceived, RequestGivenUp, RequestUnanswered, AckReceived,
    /// ProtocolNoted.
    virtual void OnText(ConnectionID connection, std::string_view text, Core::Now now, SessionActions& out) = 0;

    /// If it was the registered connection: Deliver RequestUnanswered for each pending request, then LinkLost;
    /// CancelTimer.
    virtual void OnClosed(ConnectionID connection, std::string_view reason, Core::Now now, SessionActions& out) = 0;

    /// SendText (resends, Fail for what the application has not answered), Close (no Registration in time, or none
    /// accepted), StartTimer, Deliver of RequestUnanswered, RequestGivenUp. A timer that is not running is ignored.
    virtual void OnTimer(ESessionTimer timer, Core::Now now, SessionActions& out) = 0;

    /// Answers a RequestReceived that has a token: SendText if its connection is still registered; the answer is kept for a
    /// repeated report. For a Registration: Success registers the connection (Close of the one that it replaces,
    /// RequestUnanswered, LinkLost, Registered), Fail closes it with 1008 after the Ack. Returns false and does nothing if
    /// the request waits no longer: answered, abandoned, or a Registration whose connection was closed. StartTimer,
    /// CancelTimer. The message is for the operator of the ACS and may be empty.
    [[nodiscard]] virtual bool TryAnswer(
        AnswerToken token,
        EAckResult result,
        std::string_view message,
        Core::Now now,
        SessionActions& out) = 0;

    /// Number of requests that wait for TryAnswer.
    [[nodiscard]] virtual std::size_t GetUnansweredCount() const noexcept = 0;

    /// A request with a new transactionID and the current time as its timestamp, to be sent once or more often.
    [[nodiscard]] virtual AcsRequest MakeRequest(AcsPayload payload, Core::Now now) = 0;

    /// A command that the MCS sends (IsSentByMCS): SendText, StartTimer. Ends in one AckReceived or RequestUnanswered with
    /// this transactionID. Returns false and does nothing if no ACS is registered, if too many requests are pending, for a
    /// plan while IsTakingPlans is false and the option bPlansWithheld is set, or always for a command of the ACS. Returns
    /// true and does nothing if the request is pending already.
    [[nodiscard]] virtual bool TrySend(const AcsRequest& request, Core::Now now, SessionActions& out) = 0;

    /// Whether an ACS is registered and its last AcsCommStateUpdate on this connection, if any, reported
    /// isConnected=true. Otherwise the MCS withholds its plans (section 6.21). Changes with a RequestReceived of
    /// AcsCommStateUpdate.
    [[nodiscard]] virtual bool IsTakingPlans() const noexcept = 0;

    /// The registered connection; nullopt: none.
    [[nodiscard]] virtual std::optional<ConnectionID> GetRegisteredOrNull() const noexcept = 0;

    /// Number of requests without an Ack.
    [[nodiscard]] virtual std::size_t GetPendingCount() const noexcept = 0;

    /// Counters since the session was created, over all connections.
    [[nodiscard]] virtual const SessionStatistics& GetStatistics() const noexcept = 0;
};

} // namespace ACS::Protocol
