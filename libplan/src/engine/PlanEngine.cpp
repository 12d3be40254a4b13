#include "engine/PlanEngine.Impl.hpp"

namespace ACS::Planning
{

PlanEngine::PlanEngine(EngineOptions options, SiteMap site, Core::IRandom& random)
    : _impl(std::make_unique<Impl>(std::move(options), std::move(site), random))
{
}

PlanEngine::~PlanEngine() = default;

void PlanEngine::SetObserver(IPlanObserver& observer)
{
    _impl->SetObserver(observer);
}

void PlanEngine::Restore(StoredState state, Core::Now now, EngineActions& out)
{
    _impl->Restore(std::move(state), now, out);
}

void PlanEngine::Handle(const PlanCommand& command, Core::Now now, EngineActions& out)
{
    _impl->HandleCommands({&command, 1}, {}, now, out);
}

void PlanEngine::Handle(
    std::span<const PlanCommand> commands,
    std::span<const CommandReceipt> receipts,
    Core::Now now,
    EngineActions& out)
{
    _impl->HandleCommands(commands, receipts, now, out);
}

void PlanEngine::Handle(std::string_view robotID, const RobotEvent& event, Core::Now now, EngineActions& out)
{
    _impl->HandleEvent(robotID, event, now, out);
}

void PlanEngine::OnTimer(const EngineTimer& timer, Core::Now now, EngineActions& out)
{
    _impl->OnTimer(timer, now, out);
}

void PlanEngine::OnStored(const Core::Result<void>& result, Core::Now now, EngineActions& out)
{
    _impl->OnStored(result, now, out);
}

bool PlanEngine::IsStoring() const noexcept
{
    return _impl->IsStoring();
}

void PlanEngine::OnStoreLost(std::string_view reason, Core::Now now, EngineActions& out)
{
    _impl->OnStoreLost(reason, now, out);
}

void PlanEngine::OnStoreLog(const StoreLog& log, Core::Now now, EngineActions& out)
{
    _impl->OnStoreLog(log, now, out);
}

std::vector<OutboxEntry> PlanEngine::GetUnacknowledged() const
{
    return _impl->GetUnacknowledged();
}

OutboxSummary PlanEngine::GetOutboxSummary() const
{
    return _impl->GetOutboxSummary();
}

std::vector<RobotStatus> PlanEngine::GetRobotStatuses() const
{
    return _impl->GetRobotStatuses();
}

std::vector<RobotPose> PlanEngine::GetRobotPoses() const
{
    return _impl->GetRobotPoses();
}

std::vector<RobotDetail> PlanEngine::GetRobotDetails() const
{
    return _impl->GetRobotDetails();
}

std::vector<RobotRoute> PlanEngine::GetRobotRoutes() const
{
    return _impl->GetRobotRoutes();
}

std::vector<PlanSummary> PlanEngine::GetActivePlans() const
{
    return _impl->GetActivePlans();
}

std::optional<PlanSummary> PlanEngine::GetPlanOrNull(std::string_view planID) const
{
    return _impl->GetPlanOrNull(planID);
}

const PlanRecord* PlanEngine::GetPlanRecordOrNull(std::string_view planID) const
{
    return _impl->GetPlanRecordOrNull(planID);
}

std::vector<std::reference_wrapper<const PlanRecord>> PlanEngine::GetActivePlanRecords() const
{
    return _impl->GetActivePlanRecords();
}

std::vector<std::reference_wrapper<const PlanRecord>> PlanEngine::GetFinishedPlanRecords(std::size_t limit) const
{
    return _impl->GetFinishedPlanRecords(limit);
}

std::vector<WaitReason> PlanEngine::GetWaitReasons() const
{
    return _impl->GetWaitReasons();
}

std::optional<WaitReason> PlanEngine::GetWaitReasonOrNull(std::string_view planID) const
{
    return _impl->GetWaitReasonOrNull(planID);
}

std::optional<std::string> PlanEngine::GetRejectionReasonOrNull(const SetCarriers& command) const
{
    return _impl->GetRejectionReasonOrNull(command);
}

std::optional<std::string> PlanEngine::GetRejectionReasonOrNull(const ResolveJob& command) const
{
    return _impl->GetRejectionReasonOrNull(command);
}

std::optional<std::string> PlanEngine::GetRejectionReasonOrNull(const SkipStep& command) const
{
    return _impl->GetRejectionReasonOrNull(command);
}

std::optional<std::string> PlanEngine::GetRejectionReasonOrNull(const ControlPlan& command) const
{
    return _impl->GetRejectionReasonOrNull(command);
}

std::optional<std::string> PlanEngine::GetRejectionReasonOrNull(const SetPlanPriority& command) const
{
    return _impl->GetRejectionReasonOrNull(command);
}

std::optional<std::string> PlanEngine::GetRejectionReasonOrNull(const BlockPlace& command) const
{
    return _impl->GetRejectionReasonOrNull(command);
}

std::optional<std::string> PlanEngine::GetRejectionReasonOrNull(const UnblockPlace& command) const
{
    return _impl->GetRejectionReasonOrNull(command);
}

const std::vector<Alarm>& PlanEngine::GetActiveAlarms() const noexcept
{
    return _impl->GetActiveAlarms();
}

const std::vector<Block>& PlanEngine::GetBlocks() const noexcept
{
    return _impl->GetBlocks();
}

const EngineOptions& PlanEngine::GetOptions() const noexcept
{
    return _impl->GetOptions();
}

const SiteMap& PlanEngine::GetSite() const noexcept
{
    return _impl->GetSite();
}

const std::string& PlanEngine::GetHoldReason() const noexcept
{
    return _impl->GetHoldReason();
}

ETscState PlanEngine::GetTscState() const noexcept
{
    return _impl->GetTscState();
}

} // namespace ACS::Planning
