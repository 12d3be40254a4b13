#pragma once

#include <acs/core/Now.hpp>
#include <acs/plan/IPlanObserver.hpp>

#include <cstdint>
#include <functional>
#include <string_view>

namespace ACS::Acsd
{

/// A change of state: its objects, and what happened as one line for people. The views are valid during the call only.
struct ChangeEntry
{
    std::string_view kind;    ///< "plan", "step", "job", "alarm", "robot", "tsc", "action", "note"
    std::string_view robotID; ///< Empty: none; likewise the others.
    std::string_view planID;
    std::int32_t stepNo = 0; ///< 0: none.
    std::string_view jobID;
    std::string_view text;
    std::string_view transactionID;                        ///< Of the report of the change.
    const Planning::PlanRecord* endedPlanOrNull = nullptr; ///< The plan if it has reached its last state.
};

/// Makes an entry of each change of state.
class ChangeObserver final : public Planning::IPlanObserver
{
public:
    using Handler = std::function<void(const ChangeEntry& entry, Core::Now now)>;

private:
    Handler _handler;

public:
    explicit ChangeObserver(Handler handler);

    void OnPlanChanged(
        const Planning::PlanRecord& record,
        Planning::EPlanState from,
        std::string_view transactionID,
        Core::Now now) override;
    void OnStepChanged(
        const Planning::PlanRecord& record,
        std::size_t stepIndex,
        Planning::EStepState from,
        std::string_view transactionID,
        Core::Now now) override;
    void OnJobChanged(
        const Planning::PlanRecord& record,
        std::size_t stepIndex,
        std::size_t jobIndex,
        Planning::EJobState from,
        std::string_view transactionID,
        Core::Now now) override;
    void OnAlarmChanged(const Planning::Alarm& alarm, bool bSet, std::string_view transactionID, Core::Now now)
        override;
    void OnRobotStatusChanged(const Planning::RobotStatus& status, Core::Now now) override;
    void OnTscChanged(Planning::ETscState state, Planning::ETscState from, Core::Now now) override;
    void OnNote(std::string_view robotID, std::string_view text, Core::Now now) override;
};

} // namespace ACS::Acsd
