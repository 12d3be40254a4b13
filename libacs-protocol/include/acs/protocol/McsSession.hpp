#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/IRandom.hpp>
#include <acs/protocol/IMcsSession.hpp>
#include <acs/protocol/SessionOptions.hpp>

#include <chrono>
#include <memory>

namespace ACS::Protocol
{

/// The MCS side of the protocol as a pure state machine over all connections of a server; at most one ACS is registered
/// at a time. Built like AcsSession. Every report is acknowledged with Success at once, or with the answer of the
/// application for a command in McsSessionOptions::answeredByApplication; a repeated one gets the same Ack.
class ACS_API McsSession final : public IMcsSession
{
    class ACS_HIDDEN Impl;
    std::unique_ptr<Impl> _impl;

public:
    /// The random source generates transaction ids and must outlive the session.
    McsSession(const McsSessionOptions& options, Core::IRandom& random);
    McsSession(const McsSession&) = delete;
    McsSession& operator=(const McsSession&) = delete;
    ~McsSession() override;

    [[nodiscard]] bool ShouldRefuseUpgrade() const noexcept override;
    void OnConnected(ConnectionID connection, Core::Now now, SessionActions& out) override;
    void OnText(ConnectionID connection, std::string_view text, Core::Now now, SessionActions& out) override;
    void OnClosed(ConnectionID connection, std::string_view reason, Core::Now now, SessionActions& out) override;
    void OnTimer(ESessionTimer timer, Core::Now now, SessionActions& out) override;
    [[nodiscard]] bool TryAnswer(
        AnswerToken token,
        EAckResult result,
        std::string_view message,
        Core::Now now,
        SessionActions& out) override;
    [[nodiscard]] std::size_t GetUnansweredCount() const noexcept override;
    [[nodiscard]] AcsRequest MakeRequest(AcsPayload payload, Core::Now now) override;
    [[nodiscard]] bool TrySend(const AcsRequest& request, Core::Now now, SessionActions& out) override;
    [[nodiscard]] bool IsTakingPlans() const noexcept override;
    [[nodiscard]] std::optional<ConnectionID> GetRegisteredOrNull() const noexcept override;
    [[nodiscard]] std::size_t GetPendingCount() const noexcept override;
    [[nodiscard]] const SessionStatistics& GetStatistics() const noexcept override;

    /// Whether an ACS is registered.
    [[nodiscard]] bool IsRegistered() const noexcept;

    /// UTC offset of the timestamps that are sent from now on, and of those without one that are received.
    void SetSiteOffset(std::chrono::minutes offset) noexcept;
};

} // namespace ACS::Protocol
