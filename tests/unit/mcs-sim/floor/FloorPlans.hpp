#pragma once

#include "plans/PlannedPlan.hpp"

#include <string>

namespace ACS::Testing
{

/// The document's plan for a control robot: two trays are loaded, a memory of each goes into a set, the trays go back to other
/// ports. The jobs are those of the plan, PLAN-1 to PLAN-6.
inline McsSim::PlannedPlan MakeTrayPlan(const std::string& planID)
{
    McsSim::PlannedPlan planned;
    planned.transactionID = "T-" + planID;
    planned.plan.planID = planID;
    planned.plan.steps = {
        {1,
         "TrayLoad",
         "A01.CP02",
         {"TRAY_01", "TRAY_02"},
         {{planID + "-1", "A01.CP02.TP01", "AMR.TP01"}, {planID + "-2", "A01.CP02.TP02", "AMR.TP02"}}},
        {2,
         "MemoryPickAndPlace",
         "A01.SET01",
         {},
         {{planID + "-3", "AMR.TP01.MP01", "A01.SET01.MP01"}, {planID + "-4", "AMR.TP02.MP01", "A01.SET01.MP02"}}},
        {3,
         "TrayUnload",
         "A01.CP02",
         {"TRAY_01", "TRAY_02"},
         {{planID + "-5", "AMR.TP01", "A01.CP02.TP03"}, {planID + "-6", "AMR.TP02", "A01.CP02.TP04"}}}};
    return planned;
}

} // namespace ACS::Testing
