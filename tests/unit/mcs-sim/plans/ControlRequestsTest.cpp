#include "Catch.hpp"
#include "plans/PlanTracker.hpp"
#include "plans/SamplePlans.hpp"

#include <chrono>
#include <string>
#include <utility>
#include <vector>

using ACS::McsSim::PlanTracker;
using ACS::Protocol::AbortPlan;
using ACS::Protocol::AbortResultReport;
using ACS::Protocol::AcsPayload;
using ACS::Protocol::CancelPlan;
using ACS::Protocol::CancelResultReport;
using ACS::Protocol::EAckResult;
using ACS::Protocol::EAcsCommand;
using ACS::Protocol::EJobStatus;
using ACS::Protocol::EPlanStatus;
using ACS::Protocol::EReportResult;
using ACS::Protocol::EStepStatus;
using ACS::Protocol::PausePlan;
using ACS::Protocol::PauseResultReport;
using ACS::Protocol::ResumePlan;
using ACS::Protocol::ResumeResultReport;
using ACS::Testing::MakeAck;
using ACS::Testing::MakeJobReport;
using ACS::Testing::MakePlanReport;
using ACS::Testing::MakeSamplePlan;
using ACS::Testing::MakeStepReport;

namespace
{

/// An accepted plan P1, of which the ACS reports what a test wants.
class ControlRequestsFixture
{
public:
    PlanTracker tracker{{MakeSamplePlan("P1", "T1")}};
    PlanTracker::Lines lines;
    ACS::Core::WallTime now{}; ///< By the clock of the ACS.

    ControlRequestsFixture()
    {
        tracker.OnRegistered();
        tracker.OnSent(0, {}, lines);
        tracker.OnAck(MakeAck(tracker.GetPlans()[0].planned, EAckResult::Success), lines);
    }

    void Ask(const AcsPayload& payload, const std::string& transactionID)
    {
        tracker.OnRequestSent({transactionID, {}, payload});
    }

    void Refuse(ACS::Protocol::EAcsCommand command, const std::string& transactionID)
    {
        tracker.OnAck({command, transactionID, {}, EAckResult::Fail, "", ACS::Protocol::EmptyAck{}, false}, lines);
    }

    void Accept(ACS::Protocol::EAcsCommand command, const std::string& transactionID)
    {
        tracker.OnAck(
            {command, transactionID, {now, {}}, EAckResult::Success, "", ACS::Protocol::EmptyAck{}, false},
            lines);
    }

    void Report(const std::vector<AcsPayload>& reports)
    {
        for (const AcsPayload& report : reports)
        {
            tracker.OnRequest(report, now, lines);
        }
    }

    void BeginFirstJob()
    {
        Report(
            {MakePlanReport("P1", EPlanStatus::InProgress),
             MakeStepReport("P1", 1, EStepStatus::Dispatched),
             MakeStepReport("P1", 1, EStepStatus::InProgress),
             MakeJobReport("P1", 1, "J1", EJobStatus::Instructed),
             MakeJobReport("P1", 1, "J1", EJobStatus::InProgress)});
    }

    /// The only violation; another text if there is none or more than one.
    [[nodiscard]] std::string GetViolation() const
    {
        return tracker.CountViolations() == 1 ? tracker.GetViolations().front()
                                              : std::to_string(tracker.CountViolations()) + " violations";
    }
};

} // namespace

TEST_CASE("A result report that no request asked for is a violation")
{
    ControlRequestsFixture fixture;
    using Row = std::pair<AcsPayload, std::string>;
    const Row row = GENERATE(
        Row{CancelResultReport{"P9", EReportResult::Failed, ""}, "P9 CancelResultReport for an unknown plan"},
        Row{CancelResultReport{"P1", EReportResult::Failed, ""}, "P1 CancelResultReport without an open CancelPlan"},
        Row{AbortResultReport{"P1", EReportResult::Success, ""}, "P1 AbortResultReport without an open AbortPlan"},
        Row{PauseResultReport{"P1", EReportResult::Success, ""}, "P1 PauseResultReport without an open PausePlan"},
        Row{ResumeResultReport{"P1", EReportResult::Success, ""}, "P1 ResumeResultReport without an open ResumePlan"});
    fixture.Report({row.first});
    fixture.tracker.Finish(fixture.lines);
    CHECK(fixture.GetViolation() == row.second);
}

TEST_CASE("Each request has one result, and the repetition of a request none of its own")
{
    ControlRequestsFixture fixture;
    fixture.Ask(CancelPlan{"P1", ""}, "C1");
    fixture.Ask(CancelPlan{"P1", ""}, "C1");
    fixture.Ask(CancelPlan{"P1", ""}, "C2");
    fixture.Report(
        {CancelResultReport{"P1", EReportResult::Failed, ""}, CancelResultReport{"P1", EReportResult::Failed, ""}});
    CHECK(fixture.tracker.CountViolations() == 0);
    fixture.Report({CancelResultReport{"P1", EReportResult::Failed, ""}});
    CHECK(fixture.GetViolation() == "P1 CancelResultReport without an open CancelPlan");
}

TEST_CASE("D-19 A request for an unknown plan has the result Failed, after an Ack Fail too")
{
    ControlRequestsFixture fixture;
    fixture.Ask(PausePlan{"P9", ""}, "C1");
    fixture.Refuse(ACS::Protocol::EAcsCommand::PausePlan, "C1");
    SECTION("Failed")
    {
        fixture.Report({PauseResultReport{"P9", EReportResult::Failed, ""}});
        CHECK(fixture.tracker.CountViolations() == 0);
    }
    SECTION("Success after the Ack Fail")
    {
        fixture.Report({PauseResultReport{"P9", EReportResult::Success, ""}});
        CHECK(fixture.GetViolation() == "P9 PauseResultReport Success after PausePlanAck Fail");
    }
    SECTION("Success without the Ack Fail")
    {
        fixture.Ask(ResumePlan{"P9", ""}, "C2");
        fixture.Report({ResumeResultReport{"P9", EReportResult::Success, ""}});
        CHECK(fixture.GetViolation() == "P9 ResumeResultReport Success for a plan that the ACS does not have");
    }
}

TEST_CASE("D-19 A refused request leaves the result of another one")
{
    ControlRequestsFixture fixture;
    fixture.Ask(AbortPlan{"P1", ""}, "C1");
    fixture.Ask(AbortPlan{"P1", ""}, "C2");
    fixture.Refuse(ACS::Protocol::EAcsCommand::AbortPlan, "C2");
    fixture.Report(
        {AbortResultReport{"P1", EReportResult::Failed, ""},
         MakePlanReport("P1", EPlanStatus::Aborted),
         AbortResultReport{"P1", EReportResult::Success, ""}});
    CHECK(fixture.tracker.CountViolations() == 0);
}

TEST_CASE("D-20 A request for a finished plan has the result Failed, or Success if the plan has ended so")
{
    ControlRequestsFixture fixture;
    fixture.Ask(CancelPlan{"P1", ""}, "C1");
    fixture.Ask(CancelPlan{"P1", ""}, "C2");
    fixture.Ask(AbortPlan{"P1", ""}, "C3");
    fixture.Report(
        {MakePlanReport("P1", EPlanStatus::Cancelled),
         CancelResultReport{"P1", EReportResult::Success, ""},
         CancelResultReport{"P1", EReportResult::Failed, ""}});
    CHECK(fixture.tracker.CountViolations() == 0);
    fixture.Report({AbortResultReport{"P1", EReportResult::Success, ""}});
    CHECK(fixture.GetViolation() == "P1 AbortResultReport Success while the plan is Cancelled");
}

TEST_CASE("R6 After CancelResultReport Success the plan is Cancelled, at the latest at the end of the run")
{
    ControlRequestsFixture fixture;
    fixture.Ask(CancelPlan{"P1", ""}, "C1");
    fixture.Report({CancelResultReport{"P1", EReportResult::Success, ""}});
    CHECK(fixture.tracker.CountViolations() == 0);
    SECTION("PlanReport Cancelled")
    {
        fixture.Report({MakePlanReport("P1", EPlanStatus::Cancelled)});
        fixture.tracker.Finish(fixture.lines);
        CHECK(fixture.tracker.CountViolations() == 0);
    }
    SECTION("another end")
    {
        fixture.Report({MakePlanReport("P1", EPlanStatus::InProgress), MakePlanReport("P1", EPlanStatus::Failed)});
        fixture.tracker.Finish(fixture.lines);
        CHECK(fixture.GetViolation() == "P1 PlanReport Failed after CancelResultReport Success");
    }
    SECTION("no end")
    {
        fixture.tracker.Finish(fixture.lines);
        CHECK(fixture.GetViolation() == "P1 CancelResultReport Success without PlanReport Cancelled");
    }
}

TEST_CASE("R7 The running job is completed after the ACS has accepted AbortPlan")
{
    using namespace std::chrono_literals;
    ControlRequestsFixture fixture;
    fixture.BeginFirstJob();
    fixture.Ask(AbortPlan{"P1", ""}, "C1");
    fixture.Accept(EAcsCommand::AbortPlan, "C1");
    fixture.now += 10ms;
    fixture.Report(
        {MakeJobReport("P1", 1, "J1", EJobStatus::Completed),
         MakePlanReport("P1", EPlanStatus::Aborted),
         AbortResultReport{"P1", EReportResult::Success, ""}});
    CHECK(fixture.tracker.CountViolations() == 0);
}

TEST_CASE("R7 After the ACS has accepted AbortPlan it begins no step and no job")
{
    using namespace std::chrono_literals;
    ControlRequestsFixture fixture;
    fixture.BeginFirstJob();
    fixture.Ask(AbortPlan{"P1", ""}, "C1");
    fixture.now += 10ms;
    fixture.Report({MakeJobReport("P1", 1, "J1", EJobStatus::Completed)});
    SECTION("another step")
    {
        fixture.Accept(EAcsCommand::AbortPlan, "C1");
        fixture.now += 10ms;
        fixture.Report(
            {MakeStepReport("P1", 1, EStepStatus::Completed), MakeStepReport("P1", 2, EStepStatus::Dispatched)});
        CHECK(fixture.GetViolation() == "P1 StepReport step 2 Dispatched after the ACS accepted AbortPlan");
    }
    SECTION("another job")
    {
        fixture.Report(
            {MakeStepReport("P1", 1, EStepStatus::Completed),
             MakeStepReport("P1", 2, EStepStatus::Dispatched),
             MakeStepReport("P1", 2, EStepStatus::InProgress)});
        fixture.Accept(EAcsCommand::AbortPlan, "C1");
        SECTION("later")
        {
            fixture.now += 1ms;
            fixture.Report({MakeJobReport("P1", 2, "J2", EJobStatus::Instructed)});
            CHECK(fixture.GetViolation() == "P1 JobReport step 2 job 1 Instructed after the ACS accepted AbortPlan");
        }
        SECTION("after the result report, which comes before PlanReport Aborted")
        {
            fixture.Report(
                {AbortResultReport{"P1", EReportResult::Success, ""},
                 MakeJobReport("P1", 2, "J2", EJobStatus::Instructed)});
            CHECK(fixture.GetViolation() == "P1 JobReport step 2 job 1 Instructed after the ACS accepted AbortPlan");
        }
        SECTION("reported late, with a timestamp before the Ack")
        {
            fixture.Report({MakeJobReport("P1", 2, "J2", EJobStatus::Instructed)});
            CHECK(fixture.tracker.CountViolations() == 0);
        }
        SECTION("after the abort has failed")
        {
            fixture.now += 1ms;
            fixture.Report(
                {AbortResultReport{"P1", EReportResult::Failed, ""},
                 MakeJobReport("P1", 2, "J2", EJobStatus::Instructed)});
            CHECK(fixture.tracker.CountViolations() == 0);
        }
    }
    SECTION("an abort that was refused")
    {
        fixture.Refuse(EAcsCommand::AbortPlan, "C1");
        fixture.now += 1ms;
        fixture.Report(
            {MakeStepReport("P1", 1, EStepStatus::Completed), MakeStepReport("P1", 2, EStepStatus::Dispatched)});
        CHECK(fixture.tracker.CountViolations() == 0);
    }
}

TEST_CASE("R8 PauseResultReport Success follows PlanReport Paused")
{
    ControlRequestsFixture fixture;
    fixture.Ask(PausePlan{"P1", ""}, "C1");
    fixture.Report({MakePlanReport("P1", EPlanStatus::InProgress)});
    SECTION("as it must be")
    {
        fixture.Report(
            {MakePlanReport("P1", EPlanStatus::Paused), PauseResultReport{"P1", EReportResult::Success, ""}});
        CHECK(fixture.tracker.CountViolations() == 0);
    }
    SECTION("without it")
    {
        fixture.Report({PauseResultReport{"P1", EReportResult::Success, ""}});
        CHECK(fixture.GetViolation() == "P1 PauseResultReport Success while the plan is InProgress");
    }
}

TEST_CASE(
    "R8 After PauseResultReport Success the robot of the plan has reported Stopped before the plan is resumed or ends")
{
    using enum ACS::Protocol::ERobotStatus;
    const auto makeStatus = [](const std::string& robotID, ACS::Protocol::ERobotStatus robotStatus) {
        ACS::Protocol::RobotStatusUpdate update;
        update.robotID = robotID;
        update.robotStatus = robotStatus;
        return update;
    };
    ControlRequestsFixture fixture;
    fixture.Report(
        {makeStatus("LR01", Moving), makeStatus("LR02", Stopped), MakePlanReport("P1", EPlanStatus::InProgress)});
    const bool bAssigned = GENERATE(true, false);
    if (bAssigned)
    {
        fixture.Report({MakeStepReport("P1", 1, EStepStatus::Dispatched)});
    }
    fixture.Ask(PausePlan{"P1", ""}, "C1");
    const AcsPayload paused = MakePlanReport("P1", EPlanStatus::Paused);
    const AcsPayload result = PauseResultReport{"P1", EReportResult::Success, ""};
    const AcsPayload resumed = MakePlanReport("P1", EPlanStatus::InProgress);
    SECTION("in the order of the section")
    {
        fixture.Report({makeStatus("LR01", Stopped), paused, result, makeStatus("LR01", Moving), resumed});
        fixture.tracker.Finish(fixture.lines);
        CHECK(fixture.tracker.CountViolations() == 0);
    }
    SECTION("afterwards, from a full window, or with a fault")
    {
        fixture.Report({paused, result, makeStatus("LR01", GENERATE(Stopped, Error)), resumed});
        CHECK(fixture.tracker.CountViolations() == 0);
    }
    SECTION("the link is lost: the latest status replaces it")
    {
        fixture.Report({paused, result});
        fixture.tracker.OnLinkLost();
        fixture.Report({resumed});
        CHECK(fixture.tracker.CountViolations() == 0);
    }
    SECTION("the link is lost before the result: what the robot reported meanwhile is not known")
    {
        fixture.tracker.OnLinkLost();
        fixture.Report({paused, result, resumed, makeStatus("LR01", Moving)});
        CHECK(fixture.tracker.CountViolations() == 0);
    }
    const std::string violation =
        bAssigned ? "P1 PauseResultReport Success without RobotStatusUpdate Stopped of LR01" : "0 violations";
    SECTION("not before the plan is resumed")
    {
        fixture.Report({paused, result, makeStatus("LR01", Working), resumed, makeStatus("LR01", Stopped)});
        CHECK(fixture.GetViolation() == violation);
    }
    SECTION("not before the end of the run")
    {
        fixture.Report({paused, result});
        fixture.tracker.Finish(fixture.lines);
        CHECK(fixture.GetViolation() == violation);
    }
}

TEST_CASE("6.8 After ResumeResultReport Success the plan is no longer Paused")
{
    ControlRequestsFixture fixture;
    fixture.Ask(ResumePlan{"P1", ""}, "C1");
    fixture.Report({MakePlanReport("P1", EPlanStatus::Paused), ResumeResultReport{"P1", EReportResult::Success, ""}});
    SECTION("PlanReport Pending, in the queue")
    {
        fixture.Report({MakePlanReport("P1", EPlanStatus::Pending)});
        fixture.tracker.Finish(fixture.lines);
        CHECK(fixture.tracker.CountViolations() == 0);
    }
    SECTION("no PlanReport")
    {
        fixture.tracker.Finish(fixture.lines);
        CHECK(fixture.GetViolation() == "P1 ResumeResultReport Success without PlanReport InProgress");
    }
}
