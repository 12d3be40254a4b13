#pragma once

#include "judge/MessageEnvelope.hpp"
#include "judge/RuleBook.hpp"
#include "judge/SentRequest.hpp"
#include "RecentMap.hpp"
#include <acs/core/Now.hpp>
#include <acs/protocol/DecodeOutcome.hpp>
#include <acs/protocol/EAckResult.hpp>

#include <cstdint>
#include <optional>
#include <set>
#include <string>

namespace ACS::AcsSim
{

/// Judges how an MCS answers the requests of the ACS. Pure.
class AckJudge
{
    RuleBook& _book;
    const Core::Duration _ackTimeout;
    RecentMap<SentRequest> _sent; ///< By transactionID.
    std::uint64_t _order = 0;
    std::uint64_t _connection = 0;
    std::uint64_t _lastCommState = 0;        ///< The order of the last AcsCommStateUpdate.
    std::optional<std::uint64_t> _malformed; ///< The order of a malformed text after which nothing was answered yet.
    bool _bRegistered = false;
    bool _bWithheld = false; ///< The MCS has acknowledged isConnected=false.

public:
    /// The book must outlive the judge.
    AckJudge(RuleBook& book, Core::Duration ackTimeout);

    /// @param bByACS The ACS has closed or broken the connection. A Registration that is sent begins the next one.
    void OnClosed(bool bByACS);
    void OnMalformedSent();
    /// @param bPlanKnown False for a report about a plan that the MCS has not sent.
    void OnRequestSent(
        const MessageEnvelope& envelope,
        const Protocol::DecodeOutcome& outcome,
        bool bPlanKnown,
        Core::SteadyTime now);
    void OnAck(const MessageEnvelope& envelope, Core::SteadyTime now);
    void OnTick(Core::SteadyTime now);

    /// The MCS may answer this request as it likes: the ACS has sent it at a wrong time. Call before OnRequestSent.
    void Excuse(const std::string& transactionID);

    /// Whether the Ack of this request is missing for too long.
    [[nodiscard]] bool IsOverdue(const std::string& transactionID) const;
    /// The transactionIDs of requests that wait for their Ack.
    [[nodiscard]] std::set<std::string> ListOpenRequests() const;
    [[nodiscard]] bool IsRegistered() const noexcept;
    [[nodiscard]] bool IsWithholdingPlans() const noexcept;

private:
    void OnConnected();
    [[nodiscard]] SentRequest* FindSentOrNull(const MessageEnvelope& envelope);
    void JudgeResult(SentRequest& sent, Protocol::EAckResult result, const std::string& name);
};

} // namespace ACS::AcsSim
