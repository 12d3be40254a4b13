#include "model/PlanExecutor.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

using namespace ACS::AcsSim;   // NOLINT(google-build-using-namespace)
using namespace ACS::Protocol; // NOLINT(google-build-using-namespace)

namespace
{

using Lines = std::vector<std::string>;

ExecutionPlan MakeCassettePlan(const std::string& planID)
{
    ExecutionPlan plan;
    plan.planID = planID;
    plan.steps = {
        {2, "CassetteUnload", "A02.CP03", {"C1"}, {{"J2", "AMR.CP01", "A02.CP03"}}},
        {1, "CassetteLoad", "A01.CP01", {"C1"}, {{"J1", "A01.CP01", "AMR.CP01"}}}};
    return plan;
}

class ExecutorFixture
{
    int _lastID = 0;

public:
    ACS::Testing::ManualClock clock;
    PlanExecutor executor;
    std::optional<SendAnswer> answer;
    Lines states; ///< Of the robots.

    explicit ExecutorFixture(PlanExecutor::Options options = {})
        : executor(std::move(options))
    {
    }

    Lines Ask(AcsPayload payload)
    {
        ExecutorActions actions;
        executor.OnRequest({fmt::format("{}", ++_lastID), {}, std::move(payload)}, clock.GetNow(), actions);
        return Read(actions);
    }

    /// Time jumps to what is due next.
    Lines Advance()
    {
        const auto due = executor.GetNextDueOrNull();
        REQUIRE(due.has_value());
        clock.Advance(std::chrono::duration_cast<std::chrono::milliseconds>(*due - clock.GetNow().steady));
        ExecutorActions actions;
        executor.OnTimer(clock.GetNow(), actions);
        return Read(actions);
    }

    Lines RunToEnd()
    {
        Lines lines;
        while (executor.GetNextDueOrNull().has_value())
        {
            const Lines next = Advance();
            lines.insert(lines.end(), next.begin(), next.end());
        }
        return lines;
    }

private:
    Lines Read(const ExecutorActions& actions)
    {
        Lines lines;
        for (const ExecutorAction& action : actions)
        {
            if (const auto* const answerOrNull = std::get_if<SendAnswer>(&action))
            {
                answer = *answerOrNull;
            }
            else if (const auto* const reportOrNull = std::get_if<SendReport>(&action))
            {
                lines.push_back(Describe(reportOrNull->payload));
            }
            else if (const auto* const statusOrNull = std::get_if<SendStatus>(&action))
            {
                const auto& status = std::get<RobotStatusUpdate>(statusOrNull->payload);
                states.push_back(fmt::format("{} {}", status.robotID, GetText(status.robotStatus)));
            }
        }
        return lines;
    }

    static std::string Describe(const AcsPayload& payload)
    {
        if (const auto* const planOrNull = std::get_if<PlanReport>(&payload))
        {
            return fmt::format("{} {}", planOrNull->planID, GetText(planOrNull->status));
        }
        if (const auto* const stepOrNull = std::get_if<StepReport>(&payload))
        {
            return fmt::format("step {} {}", stepOrNull->stepNo, GetText(stepOrNull->status));
        }
        if (const auto* const jobOrNull = std::get_if<JobReport>(&payload))
        {
            return fmt::format("{} {}", jobOrNull->jobID, GetText(jobOrNull->status));
        }
        return std::visit(
            [&payload](const auto& typed) {
                std::string text(GetText(GetCommand(payload)));
                if constexpr (requires { typed.result; })
                {
                    text += ' ';
                    text += GetText(typed.result);
                }
                return text;
            },
            payload);
    }
};

} // namespace

TEST_CASE("6.3, 7 A plan is executed in the order of its steps, and each state is reported in its order")
{
    ExecutorFixture fixture;
    CHECK(fixture.Ask(MakeCassettePlan("P")) == Lines{"P InProgress", "step 1 Dispatched", "step 1 InProgress"});
    CHECK(fixture.answer->result == EAckResult::Success);
    CHECK(
        fixture.RunToEnd()
        == Lines{
            "J1 Instructed",
            "J1 InProgress",
            "J1 Completed",
            "step 1 Completed",
            "step 2 Dispatched",
            "step 2 InProgress",
            "J2 Instructed",
            "J2 InProgress",
            "J2 Completed",
            "step 2 Completed",
            "P Completed"});
    CHECK(fixture.states.front() == "LR01 Moving");
    CHECK(fixture.states[1] == "LR01 Arrival");
    CHECK(fixture.states.back() == "LR01 Idle");
    CHECK(fixture.executor.CountEnded() == 1);
}

TEST_CASE("6.4 Plans that cannot be executed are refused")
{
    ExecutorFixture fixture;
    ExecutionPlan plan = MakeCassettePlan("P");
    SECTION("twice")
    {
        fixture.Ask(plan);
    }
    SECTION("unknown action")
    {
        plan.steps[0].action = "Dance";
    }
    SECTION("both robot types")
    {
        plan.steps[0].action = "Start";
    }
    SECTION("another robot")
    {
        plan.steps[0].jobs[0].from = "LR07.CP01";
    }
    SECTION("a stepNo twice")
    {
        plan.steps[0].stepNo = 1;
    }
    SECTION("a jobId twice")
    {
        plan.steps[0].jobs[0].jobID = "J1";
    }
    SECTION("as a fault")
    {
        fixture.executor.RefuseNextPlan();
    }
    fixture.Ask(plan);
    CHECK(fixture.answer->result == EAckResult::Fail);
    fixture.Ask(MakeCassettePlan("Q"));
    CHECK(fixture.answer->result == EAckResult::Success);
}

TEST_CASE("6.4 Beyond the limit of the queue a plan is refused")
{
    PlanExecutor::Options options;
    options.maximumQueued = 1;
    ExecutorFixture fixture(options);
    fixture.Ask(MakeCassettePlan("A")); // Executed at once.
    fixture.Ask(MakeCassettePlan("B"));
    CHECK(fixture.answer->result == EAckResult::Success);
    fixture.Ask(MakeCassettePlan("C"));
    CHECK(fixture.answer->result == EAckResult::Fail);
    CHECK(fixture.answer->message == "Queue Full");
}

TEST_CASE("6.5 A plan is cancelled until the first arrival")
{
    ExecutorFixture fixture;
    fixture.Ask(MakeCassettePlan("P"));
    SECTION("before")
    {
        CHECK(fixture.Ask(CancelPlan{"P", ""}) == Lines{"P Cancelled", "CancelResultReport Success"});
    }
    SECTION("after")
    {
        fixture.Advance();
        CHECK(fixture.Ask(CancelPlan{"P", ""}) == Lines{"CancelResultReport Failed"});
        CHECK(fixture.RunToEnd().back() == "P Completed");
    }
    SECTION("while it waits")
    {
        fixture.Ask(MakeCassettePlan("Q"));
        CHECK(fixture.Ask(CancelPlan{"Q", ""}) == Lines{"Q Cancelled", "CancelResultReport Success"});
    }
}

TEST_CASE("6.6, 6.14 An abort lets the job in progress end")
{
    ExecutorFixture fixture;
    fixture.Ask(MakeCassettePlan("P"));
    SECTION("while it drives")
    {
        CHECK(fixture.Ask(AbortPlan{"P", ""}) == Lines{"P Aborted", "AbortResultReport Success"});
    }
    SECTION("in a job")
    {
        fixture.Advance();
        CHECK(fixture.Ask(AbortPlan{"P", ""}).empty());
        CHECK(fixture.RunToEnd() == Lines{"J1 Completed", "P Aborted", "AbortResultReport Success"});
    }
}

TEST_CASE("6.7, 6.8, D-21 A plan is paused and resumed, and the time of the job is kept")
{
    ExecutorFixture fixture;
    fixture.Ask(MakeCassettePlan("P"));
    fixture.clock.Advance(std::chrono::milliseconds(400));
    CHECK(fixture.Ask(PausePlan{"P", ""}) == Lines{"P Paused", "PauseResultReport Success"});
    CHECK(fixture.states.back() == "LR01 Stopped");
    CHECK(fixture.Ask(PausePlan{"P", ""}) == Lines{"PauseResultReport Success"});
    CHECK_FALSE(fixture.executor.GetNextDueOrNull().has_value());
    fixture.clock.Advance(std::chrono::hours(1));
    CHECK(fixture.Ask(ResumePlan{"P", ""}) == Lines{"P InProgress", "ResumeResultReport Success"});
    CHECK(*fixture.executor.GetNextDueOrNull() - fixture.clock.GetNow().steady == std::chrono::milliseconds(600));
    CHECK(fixture.Ask(ResumePlan{"P", ""}) == Lines{"ResumeResultReport Failed"});
    CHECK(fixture.RunToEnd().back() == "P Completed");
}

TEST_CASE("7 A plan that waits is paused in the queue, and is Pending when it is resumed")
{
    ExecutorFixture fixture;
    fixture.Ask(MakeCassettePlan("P"));
    fixture.Ask(MakeCassettePlan("Q"));
    CHECK(fixture.Ask(ResumePlan{"Q", ""}) == Lines{"ResumeResultReport Failed"});
    CHECK(fixture.Ask(PausePlan{"Q", ""}) == Lines{"Q Paused", "PauseResultReport Success"});
    CHECK(fixture.Ask(PausePlan{"Q", ""}) == Lines{"PauseResultReport Success"});
    SECTION("it is resumed before its robot is free")
    {
        CHECK(fixture.Ask(ResumePlan{"Q", ""}) == Lines{"Q Pending", "ResumeResultReport Success"});
        CHECK(fixture.RunToEnd().back() == "Q Completed");
    }
    SECTION("its robot does not start it")
    {
        CHECK(fixture.RunToEnd().back() == "P Completed");
        CHECK(
            fixture.Ask(ResumePlan{"Q", ""})
            == Lines{
                "Q Pending",
                "ResumeResultReport Success",
                "Q InProgress",
                "step 1 Dispatched",
                "step 1 InProgress"});
        CHECK(fixture.RunToEnd().back() == "Q Completed");
    }
    SECTION("another plan overtakes it")
    {
        fixture.Ask(MakeCassettePlan("R"));
        CHECK(fixture.RunToEnd().back() == "R Completed");
    }
    SECTION("it is cancelled")
    {
        CHECK(fixture.Ask(CancelPlan{"Q", ""}) == Lines{"Q Pending", "Q Cancelled", "CancelResultReport Success"});
    }
    SECTION("it is aborted")
    {
        CHECK(fixture.Ask(AbortPlan{"Q", ""}) == Lines{"Q Aborted", "AbortResultReport Success"});
    }
}

TEST_CASE("6.5, 7 A paused plan that is cancelled passes through InProgress")
{
    ExecutorFixture fixture;
    fixture.Ask(MakeCassettePlan("P"));
    SECTION("before the first arrival")
    {
        fixture.Ask(PausePlan{"P", ""});
        CHECK(fixture.Ask(CancelPlan{"P", ""}) == Lines{"P InProgress", "P Cancelled", "CancelResultReport Success"});
    }
    SECTION("after it the plan stays paused")
    {
        fixture.Advance();
        fixture.Ask(PausePlan{"P", ""});
        CHECK(fixture.Ask(CancelPlan{"P", ""}) == Lines{"CancelResultReport Failed"});
        CHECK(fixture.Ask(ResumePlan{"P", ""}) == Lines{"P InProgress", "ResumeResultReport Success"});
    }
}

TEST_CASE("6.7, D-20 A plan that is aborted or has ended is not paused")
{
    ExecutorFixture fixture;
    fixture.Ask(MakeCassettePlan("P"));
    fixture.Advance();
    fixture.Ask(AbortPlan{"P", ""});
    CHECK(fixture.Ask(PausePlan{"P", ""}) == Lines{"PauseResultReport Failed"});
    fixture.RunToEnd();
    CHECK(fixture.Ask(PausePlan{"P", ""}) == Lines{"PauseResultReport Failed"});
}

TEST_CASE("6.14 A failed job fails its step and its plan")
{
    ExecutorFixture fixture;
    fixture.executor.FailNextJob();
    fixture.Ask(MakeCassettePlan("P"));
    CHECK(fixture.RunToEnd() == Lines{"J1 Instructed", "J1 InProgress", "J1 Failed", "step 1 Failed", "P Failed"});
    fixture.Ask(MakeCassettePlan("Q"));
    CHECK(fixture.RunToEnd().back() == "Q Completed");
}

TEST_CASE("D-17 A job that fails during an abort fails the plan and the abort")
{
    ExecutorFixture fixture;
    fixture.executor.FailNextJob();
    fixture.Ask(MakeCassettePlan("P"));
    fixture.Advance();
    fixture.Ask(AbortPlan{"P", ""});
    Lines expected{"J1 Failed", "step 1 Failed", "P Failed", "AbortResultReport Failed"};
    SECTION("once")
    {
    }
    SECTION("twice")
    {
        fixture.Ask(AbortPlan{"P", ""});
        expected.emplace_back("AbortResultReport Failed");
    }
    CHECK(fixture.RunToEnd() == expected);
}

TEST_CASE("6.14 Each AbortPlan of a plan has its result")
{
    ExecutorFixture fixture;
    fixture.Ask(MakeCassettePlan("P"));
    fixture.Advance();
    CHECK(fixture.Ask(AbortPlan{"P", ""}).empty());
    CHECK(fixture.Ask(AbortPlan{"P", ""}).empty());
    CHECK(
        fixture.RunToEnd()
        == Lines{"J1 Completed", "P Aborted", "AbortResultReport Success", "AbortResultReport Success"});
}

TEST_CASE("6.10, 6.11 Queries are answered with the present state")
{
    ExecutorFixture fixture;
    fixture.Ask(MakeCassettePlan("P"));
    fixture.Ask(MakeCassettePlan("Q"));
    fixture.Advance();
    fixture.Ask(RequestAcsPlans{});
    auto plans = std::get<PlanListAck>(fixture.answer->payload).plans;
    REQUIRE(plans.size() == 2);
    CHECK((plans[0].status == EPlanStatus::InProgress && plans[0].stepNo == 1 && plans[0].jobID == "J1"));
    CHECK((plans[1].status == EPlanStatus::Pending && !plans[1].robotID.has_value()));
    fixture.RunToEnd();
    fixture.Ask(RequestAcsPlans{});
    CHECK(std::get<PlanListAck>(fixture.answer->payload).plans.empty());
    fixture.Ask(RequestAcsPlanHistory{{"P", "unknown"}});
    plans = std::get<PlanListAck>(fixture.answer->payload).plans;
    REQUIRE(plans.size() == 1);
    CHECK((plans[0].status == EPlanStatus::Completed && plans[0].stepNo == 0 && !plans[0].jobID.has_value()));
    CHECK(plans[0].endTime.has_value());
}

TEST_CASE("The oldest of many ended plans are forgotten")
{
    ExecutorFixture fixture;
    for (std::size_t i = 0; i <= PlanExecutor::MOST_ENDED; ++i)
    {
        const std::string planID = fmt::format("P{}", i);
        fixture.Ask(MakeCassettePlan(planID));
        fixture.Ask(CancelPlan{planID, ""});
    }
    fixture.Ask(RequestAcsPlanHistory{{"P0", "P1"}});
    const auto& plans = std::get<PlanListAck>(fixture.answer->payload).plans;
    REQUIRE(plans.size() == 1);
    CHECK(plans.front().planID == "P1");
    CHECK(fixture.executor.CountEnded() == PlanExecutor::MOST_ENDED + 1);
}

TEST_CASE("D-19 A control of an unknown plan gets Fail and a result")
{
    ExecutorFixture fixture;
    CHECK(fixture.Ask(AbortPlan{"X", ""}) == Lines{"AbortResultReport Failed"});
    CHECK(fixture.answer->result == EAckResult::Fail);
}
