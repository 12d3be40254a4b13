#pragma once

#include <acs/plan/PlanCommand.hpp>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// What the present call has started and acknowledged: needed if it cannot be stored.
struct CallRecord
{
    std::vector<std::string> begunPlanIDs;
    std::map<ReplyToken, std::string> repeatedPlanIDs; ///< Plans that were submitted again.
    std::optional<ControlPlan> control;
    bool bResumeInterrupted = false;          ///< The control pauses a robot that was commanded to resume.
    std::set<std::string> unstoredControlIDs; ///< Of all calls since the store fails, as in PlanProgress::requestIDs.

    void Begin()
    {
        begunPlanIDs.clear();
        repeatedPlanIDs.clear();
        control.reset();
        bResumeInterrupted = false;
    }
};

} // namespace ACS::Planning
