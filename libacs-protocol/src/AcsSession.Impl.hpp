#pragma once

#include "AnswerCache.hpp"
#include "RecentTransactions.hpp"
#include "SessionOutput.hpp"
#include <acs/core/Backoff.hpp>
#include <acs/protocol/AcsCodec.hpp>
#include <acs/protocol/AcsSession.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Protocol
{

namespace Detail
{

///                Start        OnConnected   RegistrationAck    OnClosed    Reconnect timer   Stop
/// Stopped        Connecting
/// Connecting                  Registering                      Waiting                       Stopping
/// Registering                               Registered/Closing Waiting                       Stopping
/// Registered                                                   Waiting                       Farewell
/// Closing                                                      Waiting                       Stopping
/// Waiting                                                                  Connecting        Stopped
/// Farewell       (its Ack or the grace: Stopping)              Stopped
/// Stopping                                                     Stopped
enum class EAcsSessionState : std::uint8_t
{
    Stopped,
    Connecting,
    Registering,
    Registered,
    Closing,
    Waiting,
    Farewell,
    Stopping,
};

/// Phase of a registered connection.
enum class EConnectPhase : std::uint8_t
{
    Replay,   ///< Until ReplayDone.
    Snapshot, ///< States are sent as the window permits.
    Positions,
};

/// The requests that TrySendDurable refused because the window was full.
enum class EWaitingRequests : std::uint8_t
{
    None,
    Waiting, ///< Statuses come first.
    Next,    ///< Statuses were first: the next room is for a request.
};

/// Key of the latest status of its kind and robot. The map's order is that of sending after Registration.
using StatusKey = std::pair<EAcsCommand, std::string>;

struct Status
{
    AcsPayload payload;
    bool bPending = false;
    bool bUnanswered = false; ///< No Ack: the MCS may not know it.
    bool bEarlier = false;    ///< From before this connection.
    /// What the robot passed through on this connection and the MCS must see, oldest first: sent before the payload.
    std::deque<AcsPayload> passed{};
};

struct InFlight
{
    EAcsCommand command = EAcsCommand::Registration;
    std::string transactionID;
    std::string text;
    Core::SteadyTime deadline{};
    std::size_t resends = 0;
    bool bDurable = false;
    bool bSuperseded = false; ///< A newer status of this robot was sent: do not resend this one.
    StatusKey statusKey{};
};

} // namespace Detail

/// Connection and timers are in AcsSession.Impl.cpp, sending in AcsSession.Sending.cpp, Acks in AcsSession.Acks.cpp, the
/// requests of the MCS in AcsSession.Requests.cpp.
class AcsSession::Impl
{
    using EState = Detail::EAcsSessionState;
    using StatusKey = Detail::StatusKey;
    using Status = Detail::Status;
    using InFlight = Detail::InFlight;

    static constexpr std::size_t MOST_ABANDONED = 1'024; ///< Requests whose late Ack is still known.
    static constexpr std::size_t MOST_PASSED = 8; ///< Statuses kept per robot; beyond them the oldest is dropped.

    SessionOptions _options;
    Core::IRandom& _random;
    AcsCodec _codec;
    Core::Backoff _backoff;
    std::chrono::minutes _siteOffset;
    Detail::AnswerCache _answers;
    Detail::SessionOutput _output;

    EState _state = EState::Stopped;
    bool _bWasRegistered = false; ///< On this connection.
    Detail::EConnectPhase _phase = Detail::EConnectPhase::Replay;
    Detail::EWaitingRequests _requests = Detail::EWaitingRequests::None;
    std::string _registrationID;
    std::string _farewellID;
    std::vector<InFlight> _inFlight;
    Detail::RecentTransactions _recent;
    std::size_t _unansweredInRow = 0;
    std::map<StatusKey, Status> _statuses;
    StatusKey _lastStatus{}; ///< The last one that was sent; the next one follows it, so that each has its turn.
    Core::SteadyTime _nextPosition{};
    std::string _scratch;

public:
    Impl(const SessionOptions& options, Core::IRandom& random);
    void Start(SessionActions& out);
    void Stop(Core::Now now, SessionActions& out);
    void OnConnected(Core::Now now, SessionActions& out);
    void OnText(std::string_view text, Core::Now now, SessionActions& out);
    void OnClosed(std::string_view reason, Core::Now /*now*/, SessionActions& out);
    void OnTimer(ESessionTimer timer, Core::Now now, SessionActions& out);
    bool TrySendDurable(const AcsRequest& request, Core::Now now, SessionActions& out);
    void ReplayDone(Core::Now now, SessionActions& out);
    void SendStatus(const AcsPayload& status, Core::Now now, SessionActions& out);
    void SendPosition(const RobotPositionUpdate& positions, Core::Now now, SessionActions& out);
    void Answer(const AcsAck& answer, Core::Now now, SessionActions& out);
    [[nodiscard]] bool IsRegistered() const noexcept;
    [[nodiscard]] std::size_t GetRoom() const noexcept;
    void SetSiteOffset(std::chrono::minutes offset) noexcept;
    [[nodiscard]] const SessionStatistics& GetStatistics() const noexcept;

private:
    [[nodiscard]] bool IsUp() const noexcept;
    /// A state is sent on change only (sections 6.20, 6.21), the status of a robot always.
    [[nodiscard]] bool IsKnownState(const AcsPayload& status) const;
    /// Replaces the status. An Arrival or Stopped that waits for room on this connection is kept before it.
    static void Replace(Status& status, const AcsPayload& payload, bool bConnected);
    /// Closes the connection; OnClosed continues from the given state.
    void Leave(EState state, std::uint16_t code, std::string reason, SessionActions& out);
    /// Discards everything that ends with the connection.
    void Forget(SessionActions& out);
    void End(SessionActions& out);
    void Send(const AcsRequest& request, bool bDurable, StatusKey statusKey, Core::Now now, SessionActions& out);
    std::string SendPayload(AcsPayload payload, StatusKey statusKey, Core::Now now, SessionActions& out);
    /// Uses room in the window for statuses and, by WindowOpened, for durable requests. If both wait, they take turns.
    void UseRoom(Core::Now now, SessionActions& out);
    void OfferRoom(SessionActions& out);
    /// @param kept Room that is left.
    void SendStatuses(std::size_t kept, Core::Now now, SessionActions& out);
    /// Positions begin after the last state of the snapshot.
    [[nodiscard]] bool TryEndSnapshot(Core::Now now, SessionActions& out);
    /// Messages in flight of this kind and robot are not resent.
    void Supersede(const AcsPayload& status);
    /// All deadlines have the same timeout, so that a running timer never fires too late; if it fires too early, it is
    /// started again.
    void ArmAckTimer(Core::Now now, SessionActions& out);
    void ResendLate(Core::Now now, SessionActions& out);
    void Abandon(const InFlight& entry, SessionActions& out);
    void SchedulePosition(Core::Now now, SessionActions& out);
    void Refuse(const DecodeFailure& failure, bool bLegacyName, Core::Now now, SessionActions& out);
    [[nodiscard]] std::uint64_t MakeDigest(AcsRequest& request);
    [[nodiscard]] static DecodeFailure DescribeReuse(const AcsRequest& request);
    void HandleRequest(AcsRequest& request, bool bLegacyName, Core::Now now, SessionActions& out);
    void RefuseForeign(const AcsRequest& request, Core::Now now, SessionActions& out);
    void HandleAck(const AcsAck& ack, SessionActions& out);
    /// Whether the Ack belongs to a message that is no longer in flight: a second Ack after a resend, or a late one.
    [[nodiscard]] bool IsLateAck(const AcsAck& ack, SessionActions& out);
    void HandleRegistrationAck(const AcsAck& ack, SessionActions& out);
};

} // namespace ACS::Protocol
