#pragma once

#include <acs/core/IRandom.hpp>
#include <acs/core/Now.hpp>
#include <acs/protocol/AcsMessage.hpp>
#include <acs/protocol/SessionAction.hpp>
#include <acs/protocol/SessionOptions.hpp>
#include <acs/protocol/SessionStatistics.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Protocol
{

/// A fault that a test tool plays: Acks come late or never.
struct AckHold
{
    std::optional<EAcsCommand> command;             ///< Whose Acks; nullopt: those of every command.
    std::optional<std::chrono::milliseconds> delay; ///< Nullopt: they are never sent.
    std::chrono::milliseconds duration{0};          ///< How long from now on.

    bool operator==(const AckHold&) const = default;
};

/// The MCS's side of the protocol as a pure state machine over all connections of a server: one ACS is registered at a
/// time. Built like AcsSession. Every report is acknowledged at once with Success, a repeated one again.
class McsSession
{
    class Impl;
    std::unique_ptr<Impl> _impl;

public:
    /// The random source makes transaction ids; it outlives the session.
    McsSession(const McsSessionOptions& options, Core::IRandom& random);
    McsSession(const McsSession&) = delete;
    McsSession& operator=(const McsSession&) = delete;
    ~McsSession();

    /// Whether an upgrade is to be refused with 403 now (option bSecondRefused, and a connection is there).
    [[nodiscard]] bool ShouldRefuseUpgrade() const noexcept;

    /// A client has connected: StartTimer. Ids are the caller's, never used twice.
    void OnConnected(ConnectionID connection, Core::Now now, SessionActions& out);

    /// SendText (Acks), Close (a connection that is replaced, or the second one where that is refused), CancelTimer,
    /// StartTimer, Deliver of Registered, LinkLost, RequestReceived, AckReceived, ProtocolNoted.
    void OnText(ConnectionID connection, std::string_view text, Core::Now now, SessionActions& out);

    /// Where it was the registered one: Deliver RequestUnanswered for all that waits, then LinkLost; CancelTimer.
    void OnClosed(ConnectionID connection, std::string_view reason, Core::Now now, SessionActions& out);

    /// Deliver RequestUnanswered, SendText (Acks that were held back), Close (no Registration in time, or replaced),
    /// Deliver of Registered and LinkLost (a Registration whose Ack was held back), StartTimer.
    void OnTimer(ESessionTimer timer, Core::Now now, SessionActions& out);

    /// A request with a fresh transactionID and the present as its timestamp, to be sent once or more often.
    [[nodiscard]] AcsRequest MakeRequest(AcsPayload payload, Core::Now now);

    /// SendText, StartTimer. False, and nothing done, where no ACS is registered, too many requests wait, or the request
    /// is a plan, IsTakingPlans says no and bPlansWithheld is set.
    [[nodiscard]] bool TrySend(const AcsRequest& request, Core::Now now, SessionActions& out);

    /// Close of the registered connection, for example to show what a cut does. Nothing where there is none.
    void Drop(std::uint16_t code, std::string_view reason, SessionActions& out);

    [[nodiscard]] bool IsRegistered() const noexcept;

    /// Whether an ACS is registered and its last AcsCommStateUpdate on this connection, if any, said isConnected=true:
    /// until then the MCS keeps its plans (section 6.21). Changes with a RequestReceived of AcsCommStateUpdate.
    [[nodiscard]] bool IsTakingPlans() const noexcept;

    /// SendText of any text at all, which is not followed to an Ack. False where no ACS is registered.
    [[nodiscard]] bool TrySendText(std::string_view text, SessionActions& out);

    /// From now on Acks come late or never. What is reported is delivered all the same. A report that an earlier hold
    /// names too is subject to the latest. No action.
    void HoldAcks(const AckHold& hold, Core::Now now);

    /// The next registrations are answered with Fail and this message, and the connection is left to the ACS; zero ends
    /// that. No action.
    void RefuseRegistrations(std::size_t count, std::string_view message);

    /// No holds and no refusals from now on; Acks that are held back come when they would have. No action.
    void EndFaults() noexcept;

    /// Which connection is registered; nullopt: none.
    [[nodiscard]] std::optional<ConnectionID> GetRegisteredOrNull() const noexcept;

    /// Requests that wait for their Ack.
    [[nodiscard]] std::size_t GetPendingCount() const noexcept;

    /// For the timestamps sent from now on.
    void SetSiteOffset(std::chrono::minutes offset) noexcept;

    [[nodiscard]] const SessionStatistics& GetStatistics() const noexcept;
};

} // namespace ACS::Protocol
