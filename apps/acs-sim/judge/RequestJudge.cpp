#include "judge/RequestJudge.hpp"

#include "judge/PlanChecks.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::AcsSim
{

using Core::QuoteForError;
using Protocol::EAckResult;
using Protocol::EAcsCommand;

namespace
{

bool IsUUID(std::string_view text)
{
    constexpr std::size_t LENGTH = 36;
    constexpr std::array<std::size_t, 4> DASHES{8, 13, 18, 23};
    if (text.size() != LENGTH)
    {
        return false;
    }
    for (std::size_t i = 0; i < LENGTH; ++i)
    {
        const bool bDash = std::ranges::find(DASHES, i) != DASHES.end();
        if (bDash ? text[i] != '-' : std::isxdigit(static_cast<unsigned char>(text[i])) == 0)
        {
            return false;
        }
    }
    return true;
}

bool IsLocationPath(std::string_view path)
{
    return path.ends_with(".from") || path.ends_with(".to") || path.ends_with(".position");
}

} // namespace

RequestJudge::RequestJudge(RuleBook& book)
    : _book(book)
{
}

bool RequestJudge::IsKnownPlan(std::string_view planID) const
{
    return _plans.FindOrNull(planID) != nullptr;
}

void RequestJudge::OnAnswerSent(const Protocol::DecodeOutcome& outcome)
{
    const auto* const ackOrNull =
        outcome.message.has_value() ? std::get_if<Protocol::AcsAck>(&*outcome.message) : nullptr;
    if (ackOrNull == nullptr || ackOrNull->command != EAcsCommand::ExecutionPlan)
    {
        return;
    }
    for (auto& [planID, plan] : _plans.GetEntries())
    {
        if (plan.transactionID == ackOrNull->transactionID)
        {
            plan.answer = ackOrNull->result;
        }
    }
}

void RequestJudge::OnRequest(
    const MessageEnvelope& envelope,
    const Protocol::DecodeOutcome& outcome,
    const AckJudge& acks)
{
    _book.Judge(
        ERule::NothingBeforeRegistration,
        acks.IsRegistered(),
        fmt::format("{} before the RegistrationAck", QuoteForError(envelope.command)));
    if (!outcome.message.has_value())
    {
        OnRequestFailure(outcome.message.error());
        return;
    }
    const auto* const requestOrNull = std::get_if<Protocol::AcsRequest>(&*outcome.message);
    if (requestOrNull == nullptr)
    {
        _book.Violate(ERule::KnownCommand, QuoteForError(envelope.command) + " is not a request");
        return;
    }
    const Protocol::AcsRequest& request = *requestOrNull;
    const EAcsCommand command = GetCommand(request);
    _book.Judge(ERule::KnownCommand, IsSentByMCS(command), QuoteForError(envelope.command));
    if (!IsSentByMCS(command) || !IsNewRequest(request))
    {
        return;
    }
    std::visit(
        Core::Overloaded{
            [&](const Protocol::ExecutionPlan& plan) {
                OnPlan(plan, request.transactionID, acks.IsWithholdingPlans());
            },
            [&](const auto& other) {
                _book.Keep(ERule::RequestPayload);
                if constexpr (requires {
                                  other.planID.size();
                                  other.reason;
                              })
                {
                    OnControl(envelope.command, other.planID);
                }
            }},
        request.payload);
}

void RequestJudge::OnRequestFailure(const Protocol::DecodeFailure& failure)
{
    const std::string text = fmt::format("{}: {}", QuoteForError(failure.commandName), Describe(failure.error));
    if (!failure.command.has_value() || !IsSentByMCS(*failure.command))
    {
        _book.Violate(ERule::KnownCommand, text);
        return;
    }
    _book.Keep(ERule::KnownCommand);
    if (!failure.error.path.starts_with("payload"))
    {
        _book.Violate(ERule::Envelope, text);
        return;
    }
    const bool bPlan = failure.command == EAcsCommand::ExecutionPlan;
    if (bPlan && !failure.planID.empty())
    {
        _plans.Add(failure.planID, ReceivedPlan{failure.transactionID, {}});
    }
    if (bPlan && IsLocationPath(failure.error.path))
    {
        _book.Violate(ERule::PlanLocation, text);
    }
    else
    {
        _book.Violate(bPlan ? ERule::PlanPayload : ERule::RequestPayload, text);
    }
}

bool RequestJudge::IsNewRequest(const Protocol::AcsRequest& request)
{
    const std::string quoted = QuoteForError(request.transactionID);
    const auto [payload, bNew] = _received.Add(request.transactionID, request.payload);
    if (!bNew)
    {
        const bool bSame = *payload == request.payload;
        _book.Judge(ERule::TransactionID, bSame, "two requests have " + quoted);
        return !bSame;
    }
    _book.Judge(ERule::TransactionID, IsUUID(request.transactionID), quoted + " is not a UUID");
    return true;
}

void RequestJudge::OnPlan(const Protocol::ExecutionPlan& plan, const std::string& transactionID, bool bWithheld)
{
    _book.Keep(ERule::PlanPayload);
    std::vector<PlanFinding> findings = CheckPlan(plan);
    for (const ERule rule : {ERule::PlanLocation, ERule::PlanSteps, ERule::PlanAction, ERule::PlanCarriers})
    {
        if (std::ranges::find(findings, rule, &PlanFinding::rule) == findings.end())
        {
            _book.Keep(rule);
        }
    }
    for (PlanFinding& finding : findings)
    {
        _book.Violate(finding.rule, std::move(finding.text));
    }
    if (bWithheld)
    {
        _book.Violate(ERule::PlansWithheld, "plan " + QuoteForError(plan.planID));
    }
    const auto [received, bNew] = _plans.Add(plan.planID, {});
    _book.Judge(
        ERule::PlanID,
        bNew || received->answer == EAckResult::Fail,
        fmt::format("plan {} is sent again with another transactionId", QuoteForError(plan.planID)));
    // The ACS refuses a second plan: the answer to the first one stays in effect.
    if (bNew || received->answer == EAckResult::Fail)
    {
        *received = ReceivedPlan{transactionID, {}};
    }
}

void RequestJudge::OnControl(std::string_view command, const std::string& planID)
{
    const ReceivedPlan* const planOrNull = _plans.FindOrNull(planID);
    const bool bKnown = planOrNull != nullptr && planOrNull->answer != EAckResult::Fail;
    _book.Judge(
        ERule::ControlOfKnownPlan,
        bKnown,
        fmt::format("{} of plan {}", QuoteForError(command), QuoteForError(planID)));
}

} // namespace ACS::AcsSim
