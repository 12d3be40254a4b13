#pragma once

#include "wire/AckHold.hpp"
#include "wire/McsBehaviour.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/core/Now.hpp>
#include <acs/protocol/AcsCodec.hpp>
#include <acs/protocol/McsSession.hpp>
#include <acs/protocol/SessionOptions.hpp>
#include <acs/protocol/SessionStatistics.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::McsSim
{

/// Decorates an McsSession with the behaviour of another MCS and with faults on request: Acks that are late or missing,
/// refused registrations, dropped connections. Reports are processed in any case; only their Acks are affected. An ACS
/// is registered when the Ack of its Registration leaves.
class SimulatedMcsSession final : public Protocol::IMcsSession
{
public:
    /// Call SendDelayed after this time. Replaces an earlier request.
    using DelayHandler = std::function<void(std::chrono::milliseconds delay)>;

private:
    struct ActiveHold
    {
        AckHold hold;
        Core::SteadyTime end{};
        std::uint64_t number = 0; ///< Of the fault; the later ones have higher ones.
    };

    /// An Ack, or a Registration whose Ack is delayed.
    struct DelayedText
    {
        Protocol::ConnectionID connection = 0;
        std::string text;
        Core::SteadyTime deadline{};
        bool bRegistration = false;
    };

    Protocol::McsSession _session;
    Protocol::AcsCodec _codec;
    McsBehaviour _behaviour;
    DelayHandler _onDelay;
    std::vector<ActiveHold> _holds;
    std::vector<DelayedText> _delayed;
    std::uint64_t _faults = 0; ///< Number of the latest fault.
    std::uint64_t _refusalNumber = 0;
    std::size_t _refusalsLeft = 0;
    std::string _refusalMessage;
    std::chrono::minutes _siteOffset;
    Protocol::SessionStatistics _unsent;      ///< Acks that the session counted and that were withheld.
    Protocol::CommandCounters _intercepted{}; ///< Registrations that the session has not seen.
    mutable Protocol::SessionStatistics _statistics;

public:
    /// The random source generates transaction ids and must outlive the session.
    SimulatedMcsSession(
        const Protocol::McsSessionOptions& options,
        const McsBehaviour& behaviour,
        Core::IRandom& random,
        DelayHandler onDelay);

    [[nodiscard]] bool ShouldRefuseUpgrade() const noexcept override;
    void OnConnected(Protocol::ConnectionID connection, Core::Now now, Protocol::SessionActions& out) override;
    void OnText(Protocol::ConnectionID connection, std::string_view text, Core::Now now, Protocol::SessionActions& out)
        override;
    void OnClosed(
        Protocol::ConnectionID connection,
        std::string_view reason,
        Core::Now now,
        Protocol::SessionActions& out) override;
    void OnTimer(Protocol::ESessionTimer timer, Core::Now now, Protocol::SessionActions& out) override;
    [[nodiscard]] bool TryAnswer(
        Protocol::AnswerToken token,
        Protocol::EAckResult result,
        std::string_view message,
        Core::Now now,
        Protocol::SessionActions& out) override;
    [[nodiscard]] std::size_t GetUnansweredCount() const noexcept override;
    [[nodiscard]] Protocol::AcsRequest MakeRequest(Protocol::AcsPayload payload, Core::Now now) override;
    [[nodiscard]] bool TrySend(const Protocol::AcsRequest& request, Core::Now now, Protocol::SessionActions& out)
        override;
    [[nodiscard]] bool IsTakingPlans() const noexcept override;
    [[nodiscard]] std::optional<Protocol::ConnectionID> GetRegisteredOrNull() const noexcept override;
    [[nodiscard]] std::size_t GetPendingCount() const noexcept override;
    [[nodiscard]] const Protocol::SessionStatistics& GetStatistics() const noexcept override;

    /// SendText of any text, which is not tracked to an Ack. False if no ACS is registered.
    [[nodiscard]] bool TrySendText(std::string_view text, Protocol::SessionActions& out) const;

    /// From now on Acks are sent late or never. If several holds match a command, the latest one applies.
    void HoldAcks(const AckHold& hold, Core::Now now);

    /// The next registrations are answered with Fail and this message; their connections stay open. 0 ends that. It overrides
    /// an earlier hold of Acks without a delay. A later hold overrides it: a registration without an Ack does not count.
    void RefuseRegistrations(std::size_t count, std::string_view message);

    /// Ends all holds and refusals; delayed Acks are still sent at their time.
    void EndFaults() noexcept;

    /// What the DelayHandler asked for: SendText, and Deliver of a delayed registration.
    void SendDelayed(Core::Now now, Protocol::SessionActions& out);

    /// Close of the registered connection; CLOSE_ABNORMAL skips the closing handshake. Nothing if no ACS is registered.
    void Drop(std::uint16_t code, std::string_view reason, Protocol::SessionActions& out) const;

private:
    [[nodiscard]] std::string_view GetReadPart(std::string_view text) const;
    [[nodiscard]] const ActiveHold* FindHoldOrNull(Protocol::EAcsCommand command, Core::Now now) const;
    /// Whether the text is a Registration that a fault keeps from the session.
    [[nodiscard]] bool ShouldIntercept(
        Protocol::ConnectionID connection,
        std::string_view text,
        Core::Now now,
        Protocol::SessionActions& out);
    /// Moves what is carried out now from the actions of one call to out.
    void Filter(Protocol::SessionActions& actions, Core::Now now, Protocol::SessionActions& out);
    /// Whether the action, one of a call of OnText or TryAnswer, is carried out now.
    [[nodiscard]] bool ShouldKeep(Protocol::SessionAction& action, bool bConnectionRefused, Core::Now now);
    void Delay(DelayedText delayed, Core::Now now);
    void RequestDelay(Core::Now now) const;
    /// How long a Registration, or its refusal, is still held at most; nullopt if none is.
    [[nodiscard]] std::optional<std::chrono::milliseconds> GetHeldTimeOrNull(Core::Now now) const;
};

} // namespace ACS::McsSim
