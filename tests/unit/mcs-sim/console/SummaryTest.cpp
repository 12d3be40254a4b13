#include "console/Summary.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"
#include "plans/SamplePlans.hpp"

#include <chrono>
#include <string>
#include <vector>

using ACS::McsSim::MakeLastLine;
using ACS::McsSim::MakeSummary;
using ACS::McsSim::PlanTracker;
using ACS::McsSim::StyledLine;
using ACS::Protocol::CommandCounters;
using ACS::Protocol::EAckResult;
using ACS::Protocol::EAcsCommand;
using ACS::Protocol::EPlanStatus;
using ACS::Protocol::EProtocolNote;
using ACS::Protocol::SessionStatistics;
using ACS::Testing::MakeAck;
using ACS::Testing::MakePlanReport;
using ACS::Testing::MakeSamplePlan;
using ACS::Testing::ManualClock;

namespace
{

CommandCounters MakeReceived(
    std::uint64_t received,
    std::uint64_t duplicates,
    std::uint64_t acknowledged,
    std::uint64_t refused = 0)
{
    CommandCounters counters;
    counters.received = received;
    counters.duplicates = duplicates;
    counters.acknowledged = acknowledged;
    counters.refused = refused;
    return counters;
}

} // namespace

TEST_CASE("The closing table counts plans by outcome and messages by command, a repeated one once")
{
    PlanTracker tracker({MakeSamplePlan("P1", "T1"), MakeSamplePlan("P2", "T2"), MakeSamplePlan("P3", "T3")});
    std::vector<std::string> lines;
    const ManualClock clock;
    tracker.OnRegistered();
    for (const std::size_t index : {0U, 1U, 2U, 1U})
    {
        tracker.OnSent(index, clock.GetNow(), lines);
    }
    tracker.OnAck(MakeAck(tracker.GetPlans()[1].planned, EAckResult::Fail, "Queue Full"), lines);
    tracker.OnRequest(MakePlanReport("P1", EPlanStatus::InProgress), {}, lines);
    tracker.OnRequest(MakePlanReport("P1", EPlanStatus::Completed), {}, lines); // before its steps: a violation

    SessionStatistics statistics;
    statistics.registrations = 3;
    statistics.Of(EAcsCommand::ExecutionPlan).sent = 4;
    statistics.Of(EAcsCommand::ExecutionPlan).answered = 1;
    statistics.Of(EAcsCommand::CancelPlan).sent = 2;
    statistics.Of(EAcsCommand::CancelPlan).answered = 1;
    statistics.Of(EAcsCommand::Registration) = MakeReceived(3, 0, 3);
    statistics.Of(EAcsCommand::PlanReport) = MakeReceived(7, 2, 7, 3); // those that were refused were none
    statistics.Of(EAcsCommand::RobotPositionUpdate) = MakeReceived(500, 0, 0);
    ACS::McsSim::NoteCounts notes{};
    notes[static_cast<std::size_t>(EProtocolNote::NullOptional)] = 12;
    notes[static_cast<std::size_t>(EProtocolNote::Undecodable)] = 3;

    ACS::McsSim::TimestampCounts timestamps{};
    timestamps[static_cast<std::size_t>(ACS::McsSim::ETimestampDeviation::Utc)] = 5;

    std::string text;
    for (const StyledLine& line :
         MakeSummary(tracker, statistics, notes, timestamps, 4, std::chrono::milliseconds(34'260)))
    {
        text += MakeText(line, 100, false) + "\n";
    }
    const char* const expected = R"( ────────────────────────────────────────────────────────────────────────────
 plans                   1 completed, 0 failed, 1 refused, 1 unfinished
 steps                   0 of 6 completed
 jobs                    0 of 9 completed
 violations              1
 reconnects              2
 duration                34.3 s

 message to the ACS               sent acknowledged   sent again
 ExecutionPlan                       3            1            1
 CancelPlan                          2            1            –

 message from the ACS         received acknowledged   sent again      refused
 Registration                        3            3            0            0
 PlanReport                          2            2            2            3
 RobotPositionUpdate               500            –            –            –

 noticed in what the ACS sent
     12 null where a member is left out
      3 unreadable message
      5 timestamp with Z instead of the offset of local time
      4 required member left out
 ────────────────────────────────────────────────────────────────────────────
 P2 refused: Queue Full
 violation: P1 PlanReport Completed before all its steps
)";
    CHECK(text == expected);
    CHECK(MakeLastLine(tracker) == "1 plans completed, 1 failed");
    CHECK(ACS::McsSim::MakeDeliveryLine({3, 1}) == "3 carriers delivered, 1 misplaced");
}
