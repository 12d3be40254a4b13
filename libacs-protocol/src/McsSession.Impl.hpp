#pragma once

#include "RecentTransactions.hpp"
#include "SessionOutput.hpp"
#include "TransactionMemory.hpp"
#include <acs/protocol/AcsCodec.hpp>
#include <acs/protocol/McsSession.hpp>

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Protocol
{

namespace Detail
{

/// A request of the MCS without an Ack.
struct PendingRequest
{
    EAcsCommand command = EAcsCommand::ExecutionPlan;
    std::string transactionID;
    std::string planID; ///< Empty where it names none.
    Core::SteadyTime deadline{};
    std::size_t attempts = 1;
    std::string text; ///< Empty if it is not sent again.
};

/// A request of the ACS that waits for the application.
struct UnansweredRequest
{
    AnswerToken token = NO_ANSWER;
    EAcsCommand command = EAcsCommand::PlanReport;
    std::string transactionID;
    ConnectionID connection = 0; ///< The last one that it came on.
    Core::SteadyTime deadline{};
};

struct UnregisteredConnection
{
    ConnectionID id = 0;
    Core::SteadyTime deadline{}; ///< For its Registration.
};

} // namespace Detail

/// Connections and timers are in McsSession.Impl.cpp, the requests of the ACS and their answers in McsSession.Requests.cpp,
/// the requests of the MCS and their Acks in McsSession.Sending.cpp.
class McsSession::Impl
{
    using PendingRequest = Detail::PendingRequest;
    using UnansweredRequest = Detail::UnansweredRequest;
    using UnregisteredConnection = Detail::UnregisteredConnection;

    McsSessionOptions _options;
    Core::IRandom& _random;
    AcsCodec _codec;
    std::chrono::minutes _siteOffset;
    Detail::SessionOutput _output;

    std::vector<ConnectionID> _connections;            ///< All open connections.
    std::vector<UnregisteredConnection> _unregistered; ///< Open connections without a Registration.
    std::optional<ConnectionID> _registered;
    bool _bAcsConnected = true; ///< The last AcsCommStateUpdate of the registered ACS.
    std::vector<PendingRequest> _pending;
    Detail::RecentTransactions _recent;
    std::vector<UnansweredRequest> _unanswered; ///< At most one Registration of a connection.
    AnswerToken _lastToken = NO_ANSWER;
    Detail::TransactionMemory _seen;
    std::string _scratch;

public:
    Impl(const McsSessionOptions& options, Core::IRandom& random);
    [[nodiscard]] bool ShouldRefuseUpgrade() const noexcept;
    void OnConnected(ConnectionID connection, Core::Now now, SessionActions& out);
    void OnText(ConnectionID connection, std::string_view text, Core::Now now, SessionActions& out);
    void OnClosed(ConnectionID connection, std::string_view reason, SessionActions& out);
    void OnTimer(ESessionTimer timer, Core::Now now, SessionActions& out);
    [[nodiscard]] bool TryAnswer(
        AnswerToken token,
        EAckResult result,
        std::string_view message,
        Core::Now now,
        SessionActions& out);
    [[nodiscard]] std::size_t GetUnansweredCount() const noexcept;
    [[nodiscard]] AcsRequest MakeRequest(AcsPayload payload, Core::Now now);
    [[nodiscard]] bool TrySend(const AcsRequest& request, Core::Now now, SessionActions& out);
    [[nodiscard]] const std::optional<ConnectionID>& GetRegisteredOrNull() const noexcept;
    [[nodiscard]] bool IsTakingPlans() const noexcept;
    [[nodiscard]] std::size_t GetPendingCount() const noexcept;
    void SetSiteOffset(std::chrono::minutes offset) noexcept;
    [[nodiscard]] const SessionStatistics& GetStatistics() const noexcept;

private:
    // McsSession.Impl.cpp
    void ArmRegistrationTimer(Core::Now now, SessionActions& out);
    void RemoveUnregistered(ConnectionID connection, SessionActions& out);
    void CloseUnregistered(Core::Now now, SessionActions& out);
    void EndRegistration(EUnansweredReason reason, std::string_view text, SessionActions& out);

    // McsSession.Requests.cpp
    void Refuse(ConnectionID connection, const DecodeFailure& failure, Core::Now now, SessionActions& out);
    void HandleRequest(ConnectionID connection, AcsRequest& request, Core::Now now, SessionActions& out);
    void Register(ConnectionID connection, AcsRequest& request, Core::Now now, SessionActions& out);
    void AcceptRegistration(
        ConnectionID connection,
        std::string_view transactionID,
        std::string_view message,
        Core::Now now,
        SessionActions& out);
    void RefuseRegistration(
        ConnectionID connection,
        std::string_view transactionID,
        std::string_view message,
        Core::Now now,
        SessionActions& out);
    /// A report that the session answers.
    void AnswerReport(ConnectionID connection, AcsRequest& request, Core::Now now, SessionActions& out);
    /// A report that the application answers.
    void AskForAnswer(ConnectionID connection, AcsRequest& request, Core::Now now, SessionActions& out);
    /// Delivers the request with a token, and waits for its answer.
    void Await(ConnectionID connection, AcsRequest& request, bool bDuplicate, Core::Now now, SessionActions& out);
    /// The entry of a report on any connection, or of the Registration of this connection.
    [[nodiscard]] UnansweredRequest* FindUnansweredOrNull(ConnectionID connection, const AcsRequest& request);
    void GiveUpOverdue(Core::Now now, SessionActions& out);
    void ArmAnswerTimer(Core::Now now, SessionActions& out);
    /// Sends the first answer to a report, and keeps it for a repeated one.
    void AnswerFirst(
        ConnectionID connection,
        EAcsCommand command,
        std::string_view transactionID,
        EAckResult result,
        std::string_view message,
        Core::Now now,
        SessionActions& out);
    void SendAnswer(
        ConnectionID connection,
        EAcsCommand command,
        std::string_view transactionID,
        const Detail::GivenAnswer& answer,
        SessionActions& out);
    [[nodiscard]] Detail::GivenAnswer MakeAnswer(EAckResult result, std::string_view message, Core::Now now) const;

    // McsSession.Sending.cpp
    [[nodiscard]] bool IsWithheld(EAcsCommand command) const noexcept;
    void HandleAck(AcsAck& ack, SessionActions& out);
    void Abandon(const PendingRequest& request, EUnansweredReason reason, SessionActions& out);
    void ResendOverdue(Core::Now now, SessionActions& out);
    void ArmAckTimer(Core::Now now, SessionActions& out);
};

} // namespace ACS::Protocol
