#include <acs/core/Overloaded.hpp>
#include <acs/plan/MemoryPlanStore.hpp>

#include <algorithm>
#include <utility>

namespace ACS::Planning
{

namespace
{

void ApplyChange(StoredState& state, const StoreChange& change)
{
    std::visit(
        Core::Overloaded{
            [&state](const PlanAdded& added) { state.plans.push_back(added.record); },
            [&state](const PlanProgressed& progressed) {
                const auto found = std::ranges::find_if(state.plans, [&progressed](const PlanRecord& record) {
                    return record.plan.planID == progressed.planID;
                });
                if (found != state.plans.end())
                {
                    found->progress = progressed.progress;
                }
            },
            [&state](const PlanRemoved& removed) {
                std::erase_if(state.plans, [&removed](const PlanRecord& record) {
                    return record.sequence == removed.sequence;
                });
            },
            [&state](const ReportAdded& added) {
                state.outbox.push_back(added.entry);
                state.lastReportSequence = std::max(state.lastReportSequence, added.entry.sequence);
            },
            [&state](const ReportRemoved& removed) {
                std::erase_if(state.outbox, [&removed](const OutboxEntry& entry) {
                    return entry.sequence == removed.sequence;
                });
            },
            [&state](const CarriersChanged& changed) {
                std::erase_if(state.carriers, [&changed](const CarriersChanged& known) {
                    return known.robotID == changed.robotID;
                });
                state.carriers.push_back(changed);
            },
            [&state](const RobotWorkChanged& changed) {
                std::erase_if(state.robotWorks, [&changed](const RobotWorkChanged& known) {
                    return known.robotID == changed.robotID;
                });
                state.robotWorks.push_back(changed);
            },
            [&state](const MaintenanceChanged& changed) {
                std::erase(state.robotsInMaintenance, changed.robotID);
                if (changed.bOn)
                {
                    state.robotsInMaintenance.push_back(changed.robotID);
                }
            },
            [&state](const BlockAdded& added) { state.blocks.push_back(added.block); },
            [&state](const BlockRemoved& removed) {
                std::erase_if(state.blocks, [&removed](const Block& block) {
                    return block.kind == removed.kind && block.id == removed.id;
                });
            },
            [&state](const ReceiptAdded& added) {
                std::erase_if(state.receipts, [&added](const CommandReceipt& receipt) {
                    return added.receipt.time - receipt.time >= CommandReceipt::KEPT;
                });
                if (state.receipts.size() >= CommandReceipt::MOST_RECEIPTS)
                {
                    state.receipts.erase(state.receipts.begin());
                }
                state.receipts.push_back(added.receipt);
            },
            [&state](const TscChanged& changed) {
                state.tscState = changed.state;
                if (changed.state == ETscState::Auto)
                {
                    state.holdReason.clear();
                }
            },
            [&state](const AlarmSet& set) { state.alarms.push_back(set.alarm); },
            [&state](const AlarmCleared& cleared) {
                std::erase_if(state.alarms, [&cleared](const Alarm& alarm) { return alarm.IsSameAs(cleared.alarm); });
            }},
        change);
}

} // namespace

Core::Result<StoredState> MemoryPlanStore::Load()
{
    return _state;
}

Core::Result<void> MemoryPlanStore::Append(const StoreBatch& batch)
{
    for (const StoreChange& change : batch.changes)
    {
        ApplyChange(_state, change);
    }
    return {};
}

Core::Result<void> MemoryPlanStore::Check()
{
    return {};
}

StoreLog MemoryPlanStore::CheckLog()
{
    return {};
}

void MemoryPlanStore::SetHoldReason(std::string reason)
{
    _state.holdReason = std::move(reason);
}

const StoredState& MemoryPlanStore::GetState() const noexcept
{
    return _state;
}

} // namespace ACS::Planning
