#pragma once

#include "ManualClock.hpp"
#include <acs/plan/IPlanStore.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

// What the tests of all stores write.

namespace ACS::Planning::Test
{

inline PlanRecord MakeRecord(std::uint64_t sequence, const std::string& planID)
{
    PlanRecord record;
    record.sequence = sequence;
    record.acceptedAt = Testing::ManualClock().GetNow().wall;
    record.plan = {planID, "LOT", 3, {{1, "CassetteLoad", "A01.CP01", {"C1"}, {{"J1", "A01.CP01", "AMR.CP01"}}}}};
    record.progress.steps = {{EStepState::Pending, {EJobState::Pending}}};
    record.transactionID = "request-" + planID;
    return record;
}

inline OutboxEntry MakeEntry(std::uint64_t sequence, const std::string& planID)
{
    return {
        sequence,
        "transaction-" + std::to_string(sequence),
        Testing::ManualClock().GetNow().wall,
        PlanReport{planID, EPlanState::InProgress, ""}};
}

inline const Alarm& GetAlarm()
{
    static const Alarm ALARM{"LR01", "ACS-1001", EAlarmLevel::Heavy, "look", "P1", 1, "J1"};
    return ALARM;
}

/// Changes of every kind, in four batches.
inline std::vector<StoreBatch> MakeBatches()
{
    PlanProgressed progressed{"P1", MakeRecord(1, "P1").progress};
    progressed.progress.state = EPlanState::InProgress;
    progressed.progress.robotID = "LR01";
    progressed.progress.startedAt = Testing::ManualClock().GetNow().wall;
    progressed.progress.bArrived = true;
    progressed.progress.control = EPlanControl::Pause;
    progressed.progress.controlCount = 2;
    progressed.progress.controlOrigin = EControlOrigin::Operator;
    progressed.progress.requestIDs = {"T1", "T2"};
    const RobotWorkChanged
        work{"LR01", "C1", {"C0"}, std::nullopt, "5 5 0", true, false, {"N1", "N2"}, false, 0, "J0", {}};
    const StartJob job{"P1", 1, "J1", "CassetteLoad", "A01.CP01", "A01.CP01", "LR01.CP01", "C1", "C2", "5 5 0"};
    const RobotWorkChanged later{"LR01", "C2", {"C1", "C0"}, job, "", false, true, {"N2"}, true, 7, {}, job};
    return {
        {{PlanAdded{MakeRecord(1, "P1")}, PlanAdded{MakeRecord(2, "P2")}, PlanAdded{MakeRecord(3, "P3")}}},
        {{progressed,
          ReportAdded{MakeEntry(1, "P1")},
          ReportAdded{MakeEntry(2, "P1")},
          AlarmSet{GetAlarm()},
          CarriersChanged{"LR01", {std::nullopt}},
          work}},
        {{PlanRemoved{3},
          TscChanged{ETscState::Pausing},
          MaintenanceChanged{"LR01", true},
          MaintenanceChanged{"CR01", true},
          MaintenanceChanged{"LR01", false},
          MaintenanceChanged{"CR01", true},
          BlockAdded{Block{EBlockKind::Node, "L03", "oil", Testing::ManualClock().GetNow().wall}},
          BlockAdded{Block{EBlockKind::Edge, "L03", "", Testing::ManualClock().GetNow().wall}},
          BlockAdded{Block{EBlockKind::Station, "A01.CP01", "", Testing::ManualClock().GetNow().wall}},
          BlockRemoved{EBlockKind::Node, "L03"},
          BlockAdded{Block{EBlockKind::Node, "L03", "ice", Testing::ManualClock().GetNow().wall}}}},
        {{ReportRemoved{1},
          CarriersChanged{"LR01", {"C1"}},
          ReportAdded{MakeEntry(3, "P1")},
          ReportRemoved{3},
          ReceiptAdded{{"token lee", "k1", R"({"status":202})", Testing::ManualClock().GetNow().wall}},
          ReceiptAdded{{"token kim", "k1", {}, Testing::ManualClock().GetNow().wall}},
          later}}};
}

} // namespace ACS::Planning::Test
