#include "robots/VehicleJob.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace ACS::Acsd
{

void VehicleJob::Defer(Planning::StartJob job)
{
    _state = Deferred{std::move(job)};
}

void VehicleJob::OnOffline(bool bUnsent)
{
    if (bUnsent && GetRunningOrNull() != nullptr)
    {
        Defer(TakeRunning());
    }
    if (Deferred* const deferredOrNull = std::get_if<Deferred>(&_state); deferredOrNull != nullptr)
    {
        deferredOrNull->bOutdated = true;
    }
}

void VehicleJob::Recover(Planning::RecoverJob recovery)
{
    _state = Recovering{std::move(recovery)};
}

void VehicleJob::Run(Planning::StartJob job)
{
    _state = Running{std::move(job)};
}

void VehicleJob::VerifyLoads(LoadCheck check)
{
    _state = VerifyingLoads{std::move(check)};
}

void VehicleJob::Interrupt(std::string reason)
{
    _state = Interrupted{TakeRunning(), std::move(reason)};
}

bool VehicleJob::TryAwaitLoads()
{
    assert(std::holds_alternative<Interrupted>(_state));
    return !std::exchange(std::get<Interrupted>(_state).bLoadsAwaited, true);
}

void VehicleJob::StopAwaitingLoads()
{
    assert(std::holds_alternative<Interrupted>(_state));
    std::get<Interrupted>(_state).bLoadsAwaited = false;
}

void VehicleJob::Clear()
{
    _state = std::monostate{};
}

std::optional<VehicleJob::Deferred> VehicleJob::TakeDeferredOrNull()
{
    Deferred* const deferredOrNull = std::get_if<Deferred>(&_state);
    if (deferredOrNull == nullptr)
    {
        return std::nullopt;
    }
    Deferred deferred = std::move(*deferredOrNull);
    Clear();
    return deferred;
}

std::optional<Planning::RecoverJob> VehicleJob::TakeRecoveryOrNull()
{
    Recovering* const recoveringOrNull = std::get_if<Recovering>(&_state);
    if (recoveringOrNull == nullptr)
    {
        return std::nullopt;
    }
    Planning::RecoverJob recovery = std::move(recoveringOrNull->recovery);
    Clear();
    return recovery;
}

Planning::StartJob VehicleJob::TakeRunning()
{
    assert(std::holds_alternative<Running>(_state));
    Planning::StartJob job = std::move(std::get<Running>(_state).job);
    Clear();
    return job;
}

bool VehicleJob::TryStart()
{
    Running* const runningOrNull = std::get_if<Running>(&_state);
    return runningOrNull != nullptr && !std::exchange(runningOrNull->bStarted, true);
}

bool VehicleJob::TryWithdraw()
{
    assert(std::holds_alternative<Running>(_state));
    return !std::exchange(std::get<Running>(_state).bWithdrawn, true);
}

bool VehicleJob::IsDeferred(std::string_view jobID) const
{
    const Deferred* const deferredOrNull = std::get_if<Deferred>(&_state);
    return deferredOrNull != nullptr && deferredOrNull->job.jobID == jobID;
}

bool VehicleJob::HasDeferred() const
{
    return std::holds_alternative<Deferred>(_state);
}

bool VehicleJob::IsRecovering() const
{
    return std::holds_alternative<Recovering>(_state);
}

const Planning::StartJob* VehicleJob::GetRunningOrNull() const noexcept
{
    const Running* const runningOrNull = std::get_if<Running>(&_state);
    return runningOrNull == nullptr ? nullptr : &runningOrNull->job;
}

bool VehicleJob::IsWithdrawn() const noexcept
{
    const Running* const runningOrNull = std::get_if<Running>(&_state);
    return runningOrNull != nullptr && runningOrNull->bWithdrawn && !runningOrNull->bStarted;
}

bool VehicleJob::IsShownRunning(const VDA5050::StateMessage& state) const
{
    const Planning::StartJob* const jobOrNull = GetRunningOrNull();
    return jobOrNull != nullptr
        && std::ranges::any_of(state.actionStates, [jobOrNull](const VDA5050::ActionState& action) {
               return action.actionID == jobOrNull->commandID
                   && (action.actionStatus == VDA5050::EActionStatus::Initializing
                       || action.actionStatus == VDA5050::EActionStatus::Running);
           });
}

const LoadCheck* VehicleJob::GetLoadCheckOrNull() const noexcept
{
    const VerifyingLoads* const verifyingOrNull = std::get_if<VerifyingLoads>(&_state);
    return verifyingOrNull == nullptr ? nullptr : &verifyingOrNull->check;
}

const VehicleJob::Interrupted* VehicleJob::GetInterruptedOrNull() const noexcept
{
    return std::get_if<Interrupted>(&_state);
}

} // namespace ACS::Acsd
