#pragma once

#include "judge/AckJudge.hpp"
#include "judge/MessageEnvelope.hpp"
#include "judge/RuleBook.hpp"
#include "judge/SentRequest.hpp"
#include "RecentMap.hpp"
#include <acs/protocol/AcsMessage.hpp>
#include <acs/protocol/DecodeOutcome.hpp>

#include <string>
#include <string_view>

namespace ACS::AcsSim
{

/// Judges the requests of an MCS. Pure.
class RequestJudge
{
    RuleBook& _book;
    RecentMap<Protocol::AcsPayload> _received; ///< By transactionID.
    RecentMap<ReceivedPlan> _plans;            ///< By planID.

public:
    /// The book must outlive the judge.
    explicit RequestJudge(RuleBook& book);

    /// @param acks What the MCS knows of the ACS.
    void OnRequest(const MessageEnvelope& envelope, const Protocol::DecodeOutcome& outcome, const AckJudge& acks);
    /// An Ack of the ACS.
    void OnAnswerSent(const Protocol::DecodeOutcome& outcome);
    /// Whether the MCS has sent the plan.
    [[nodiscard]] bool IsKnownPlan(std::string_view planID) const;

private:
    void OnRequestFailure(const Protocol::DecodeFailure& failure);
    /// False: it is a repetition.
    [[nodiscard]] bool IsNewRequest(const Protocol::AcsRequest& request);
    void OnPlan(const Protocol::ExecutionPlan& plan, const std::string& transactionID, bool bWithheld);
    void OnControl(std::string_view command, const std::string& planID);
};

} // namespace ACS::AcsSim
