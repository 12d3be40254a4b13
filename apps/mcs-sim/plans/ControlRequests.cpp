#include "plans/ControlRequests.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <optional>
#include <variant>

namespace ACS::McsSim
{

using Protocol::EAcsCommand;
using Protocol::EPlanStatus;

namespace
{

constexpr std::array RULES{
    ControlRule{EAcsCommand::CancelPlan, EAcsCommand::CancelResultReport, EPlanStatus::Cancelled},
    ControlRule{EAcsCommand::AbortPlan, EAcsCommand::AbortResultReport, EPlanStatus::Aborted},
    ControlRule{EAcsCommand::PausePlan, EAcsCommand::PauseResultReport, EPlanStatus::Paused},
    ControlRule{EAcsCommand::ResumePlan, EAcsCommand::ResumeResultReport, EPlanStatus::InProgress}};

/// Of a request to cancel, abort, pause or resume.
template <EAcsCommand COMMAND>
const std::string* GetPlanIDOrNull(const Protocol::PlanControl<COMMAND>& control)
{
    return &control.planID;
}

const std::string* GetPlanIDOrNull(const auto& /*other*/)
{
    return nullptr;
}

} // namespace

const ControlRule& GetControlRule(EAcsCommand result)
{
    const auto* const found = std::ranges::find(RULES, result, &ControlRule::result);
    assert(found != RULES.end());
    return *found;
}

void ControlRequests::OnSent(const Protocol::AcsRequest& request)
{
    const std::string* const planIDOrNull =
        std::visit([](const auto& payload) { return GetPlanIDOrNull(payload); }, request.payload);
    if (planIDOrNull == nullptr)
    {
        return;
    }
    const EAcsCommand command = GetCommand(request);
    const bool bRepeated = std::ranges::any_of(_open, [command, &request](const OpenRequest& open) {
        return open.command == command && !open.transactionID.empty() && open.transactionID == request.transactionID;
    });
    if (!bRepeated)
    {
        _open.push_back({command, *planIDOrNull, request.transactionID, false});
    }
}

void ControlRequests::OnAck(const Protocol::AcsAck& ack)
{
    const auto acknowledged = std::ranges::find_if(_open, [&ack](const OpenRequest& open) {
        return open.command == ack.command && open.transactionID == ack.transactionID;
    });
    if (acknowledged != _open.end())
    {
        acknowledged->bRefused = ack.result == Protocol::EAckResult::Fail;
        const bool bTimed =
            !acknowledged->bRefused && ack.timestamp.time != Core::WallTime(); // which stands for an unreadable one
        acknowledged->acceptedAt = bTimed ? std::optional<Core::WallTime>(ack.timestamp.time) : std::nullopt;
    }
}

void ControlRequests::OnLinkLost()
{
    std::ranges::for_each(_open, [](OpenRequest& open) { open.bInterrupted = true; });
}

bool ControlRequests::IsAborting(const std::string& planID, Core::WallTime time) const
{
    return std::ranges::any_of(_open, [&planID, time](const OpenRequest& open) {
        return open.command == EAcsCommand::AbortPlan && open.planID == planID && open.acceptedAt.has_value()
            && *open.acceptedAt < time;
    });
}

ControlRequests::EResultOrigin ControlRequests::Close(EAcsCommand result, const std::string& planID, bool bSuccess)
{
    const EAcsCommand command = GetControlRule(result).request;
    const auto find = [this, command, &planID](bool bRefused) {
        return std::ranges::find_if(_open, [command, &planID, bRefused](const OpenRequest& open) {
            return open.command == command && open.planID == planID && open.bRefused == bRefused;
        });
    };
    const auto preferred = find(!bSuccess);
    const auto found = preferred != _open.end() ? preferred : find(bSuccess);
    if (found == _open.end())
    {
        return EResultOrigin::None;
    }
    const EResultOrigin sent = found->bInterrupted ? EResultOrigin::Interrupted : EResultOrigin::Request;
    const EResultOrigin origin = found->bRefused ? EResultOrigin::Refused : sent;
    _open.erase(found);
    return origin;
}

} // namespace ACS::McsSim
