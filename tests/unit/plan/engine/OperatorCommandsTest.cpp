#include "engine/OperatorCommands.hpp"

#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

namespace
{

struct OperatorParts : EngineParts
{
    OperatorCommands commands{engine, loads, stalls, rejections, places, coordinator, work, jobs};

    /// Plan P1 of LR01 with a job whose outcome the operator decides.
    ActivePlan& BeginUnresolvedLoad()
    {
        ActivePlan& plan = BeginLoad();
        jobs.OnJobUnresolved(lr, JobUnresolved{"P1-a4", "restarted"});
        Discard();
        return plan;
    }
};

bool IsReplyAccepted(const CallOutcome& outcome)
{
    const auto replies = outcome.ListActions<ReplyCommand>();
    REQUIRE(replies.size() == 1);
    return replies.front().bAccepted;
}

} // namespace

TEST_CASE("OperatorCommands: a changed maintenance state is stored")
{
    OperatorParts parts;
    parts.lr.place.possibleNodes = {parts.FindNode("L03")};
    parts.commands.Maintain(SetMaintenance{"LR01", true, 7});
    CallOutcome outcome = parts.Collect();
    CHECK(IsReplyAccepted(outcome));
    CHECK(outcome.ListChanges<MaintenanceChanged>() == std::vector{MaintenanceChanged{"LR01", true}});
    CHECK(parts.lr.place.possibleNodes.empty());
    CHECK(parts.engine.transaction.IsDispatchNeeded());
    parts.commands.Maintain(SetMaintenance{"LR01", true, 8});
    outcome = parts.Collect();
    CHECK(IsReplyAccepted(outcome));
    CHECK(outcome.changes.empty());
    parts.commands.Maintain(SetMaintenance{"LR09", true, 9});
    CHECK_FALSE(IsReplyAccepted(parts.Collect()));
}

TEST_CASE("OperatorCommands: a cleared alarm is set again while its cause is present")
{
    OperatorParts parts;
    parts.engine.transaction.RaiseAlarm(MakeLinkAlarm("LR01", {}));
    parts.Discard();
    parts.commands.ClearByOperator(ClearAlarms{"LR01", "ACS-1002", std::nullopt, std::nullopt, 7});
    CallOutcome outcome = parts.Collect();
    CHECK(IsReplyAccepted(outcome));
    CHECK(outcome.ListClearedAlarms() == std::vector<std::string>{"ACS-1002"});
    CHECK(outcome.ListSetAlarms() == std::vector<std::string>{"ACS-1002"});
    parts.lr.view.bOnline = true;
    parts.commands.ClearByOperator(ClearAlarms{"LR01", "ACS-1002", std::nullopt, std::nullopt, 7});
    outcome = parts.Collect();
    CHECK(outcome.ListClearedAlarms().size() == 1);
    CHECK(outcome.ListSetAlarms().empty());
    parts.commands.ClearByOperator(ClearAlarms{"LR01", "ACS-1002", std::nullopt, std::nullopt, 7});
    CHECK_FALSE(IsReplyAccepted(parts.Collect()));
}

TEST_CASE("OperatorCommands: the alarm of a robot on the node of another one is set again")
{
    OperatorParts parts;
    parts.BeginDriveToLoad();
    parts.PutOn(parts.cr, "D-A01.CP01");
    REQUIRE_FALSE(parts.coordinator.TryAdvance(parts.lr, 4));
    parts.Discard();
    parts.commands.ClearByOperator(ClearAlarms{"LR01", "ACS-1003", std::nullopt, std::nullopt, 7});
    CHECK(parts.Collect().ListSetAlarms() == std::vector<std::string>{"ACS-1003"});
}

TEST_CASE("OperatorCommands: corrected carriers fit the ports and are on one robot only")
{
    OperatorParts parts;
    parts.cr.ports.Correct({"TRAY_01", std::nullopt, std::nullopt});
    const std::vector<std::vector<std::optional<std::string>>>
        rejected{{}, {"C1", "C2"}, {"TRAY_01"}, {""}, {"C\n1"}, {std::string(MAXIMUM_ID_LENGTH + 1, 'C')}};
    for (const auto& carrierIDs : rejected)
    {
        parts.commands.CorrectCarriers(SetCarriers{"LR01", carrierIDs, 7});
        const CallOutcome outcome = parts.Collect();
        CHECK_FALSE(IsReplyAccepted(outcome));
        CHECK(outcome.changes.empty());
    }
    parts.commands.CorrectCarriers(SetCarriers{"CR01", {"T1", "T1", std::nullopt}, 7});
    CHECK_FALSE(IsReplyAccepted(parts.Collect()));
    parts.engine.transaction.RaiseAlarm(MakeAlarm("LR01", ALARM_PORT, EAlarmLevel::Light, {}));
    parts.Discard();
    parts.commands.CorrectCarriers(SetCarriers{"LR01", {"C1"}, 7});
    const CallOutcome outcome = parts.Collect();
    CHECK(IsReplyAccepted(outcome));
    CHECK(outcome.ListChanges<CarriersChanged>() == std::vector{CarriersChanged{"LR01", {"C1"}, {"LR01.CP01"}}});
    CHECK(outcome.ListClearedAlarms() == std::vector<std::string>{"ACS-1004"});
}

TEST_CASE("OperatorCommands: the operator resolves a job whose outcome is unknown")
{
    OperatorParts parts;
    ActivePlan& plan = parts.BeginUnresolvedLoad();
    SECTION("it was done")
    {
        parts.commands.Resolve(ResolveJob{"P1", "P1-a4", EJobResolution::Done, 7});
        CHECK(IsReplyAccepted(parts.Collect()));
        CHECK(plan.record.progress.steps[0].state == EStepState::Completed);
        CHECK(parts.lr.ports.FindCarrierOrNull("CASSETTE_01").has_value());
    }
    SECTION("it has failed")
    {
        parts.commands.Resolve(ResolveJob{"P1", "P1-a4", EJobResolution::Failed, 7});
        CHECK(parts.Collect().ListClearedAlarms() == std::vector<std::string>{"ACS-1008"});
        CHECK(plan.record.progress.state == EPlanState::Failed);
    }
    SECTION("it is to be done again, under another command")
    {
        const std::string commandID = parts.lr.job.GetOrNull()->commandID;
        parts.commands.Resolve(ResolveJob{"P1", "P1-a4", EJobResolution::Again, 7});
        parts.Discard();
        parts.work.BeginWork(parts.lr);
        const auto jobs = parts.Collect().ListCommands<StartJob>();
        REQUIRE(jobs.size() == 1);
        CHECK(jobs.front().commandID != commandID);
    }
    SECTION("it is another job")
    {
        parts.commands.Resolve(ResolveJob{"P1", "P1-b2", EJobResolution::Done, 7});
        CHECK_FALSE(IsReplyAccepted(parts.Collect()));
    }
}

TEST_CASE("OperatorCommands: the outcome of a known job is the robot's to report while it is online")
{
    OperatorParts parts;
    ActivePlan& plan = parts.BeginLoad();
    const ResolveJob resolve{"P1", "P1-a4", EJobResolution::Failed, 7};
    parts.commands.Resolve(resolve);
    CHECK_FALSE(IsReplyAccepted(parts.Collect()));
    parts.lr.view.bOnline = false;
    CHECK(parts.commands.GetRejectionReasonOrNull(ResolveJob{"P1", "P1-a4", EJobResolution::Again, 7}).has_value());
    parts.commands.Resolve(resolve);
    CHECK(IsReplyAccepted(parts.Collect()));
    CHECK(plan.record.progress.state == EPlanState::Failed);
}

TEST_CASE("OperatorCommands: a pending step and a step with an unresolved job can be skipped")
{
    OperatorParts parts;
    SECTION("no robot has the plan")
    {
        parts.AddLoad();
        CHECK(parts.commands.GetRejectionReasonOrNull(SkipStep{"P1", 1, 7}).has_value());
        CHECK(parts.commands.GetRejectionReasonOrNull(SkipStep{"P2", 1, 7}).has_value());
    }
    SECTION("the job of the step runs")
    {
        parts.BeginLoad();
        parts.commands.Skip(SkipStep{"P1", 1, 7});
        CHECK_FALSE(IsReplyAccepted(parts.Collect()));
        CHECK(parts.commands.GetRejectionReasonOrNull(SkipStep{"P1", 3, 7}).has_value());
    }
    SECTION("the step is pending")
    {
        ActivePlan& plan = parts.BeginLoad();
        parts.commands.Skip(SkipStep{"P1", 2, 7});
        CHECK(IsReplyAccepted(parts.Collect()));
        CHECK(plan.record.progress.steps[1].state == EStepState::Skipped);
        CHECK(plan.step == 0);
    }
    SECTION("the job of the step is unresolved")
    {
        ActivePlan& plan = parts.BeginUnresolvedLoad();
        parts.commands.Skip(SkipStep{"P1", 1, 7});
        CHECK(parts.Collect().ListClearedAlarms() == std::vector<std::string>{"ACS-1008"});
        CHECK(plan.record.progress.steps[0].state == EStepState::Skipped);
        CHECK(plan.record.progress.steps[1].state == EStepState::Dispatched);
        CHECK_FALSE(parts.lr.ports.FindCarrierOrNull("CASSETTE_01").has_value());
    }
}
