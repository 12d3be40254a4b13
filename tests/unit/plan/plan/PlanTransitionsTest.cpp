#include "Catch.hpp"
#include <acs/plan/ERobotStatus.hpp>
#include <acs/plan/PlanTransitions.hpp>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace

TEST_CASE("7 Completed, Failed, Cancelled and Aborted are final and the other plan states are not")
{
    CHECK(IsFinal(EPlanState::Completed));
    CHECK(IsFinal(EPlanState::Failed));
    CHECK(IsFinal(EPlanState::Cancelled));
    CHECK(IsFinal(EPlanState::Aborted));
    CHECK_FALSE(IsFinal(EPlanState::Pending));
    CHECK_FALSE(IsFinal(EPlanState::InProgress));
    CHECK_FALSE(IsFinal(EPlanState::Paused));
}

TEST_CASE("7 Plans, steps and jobs have exactly the transitions of the section")
{
    CHECK(CanChange(EPlanState::Pending, EPlanState::InProgress));
    CHECK(CanChange(EPlanState::Paused, EPlanState::Aborted));
    CHECK_FALSE(CanChange(EPlanState::Pending, EPlanState::Completed));
    CHECK_FALSE(CanChange(EPlanState::Paused, EPlanState::Cancelled));
    CHECK(CanChange(EStepState::Dispatched, EStepState::InProgress));
    CHECK_FALSE(CanChange(EStepState::Pending, EStepState::InProgress));
    CHECK_FALSE(CanChange(EStepState::Completed, EStepState::Failed));
    CHECK(CanChange(EStepState::Pending, EStepState::Skipped));
    CHECK(CanChange(EStepState::InProgress, EStepState::Skipped));
    CHECK_FALSE(CanChange(EStepState::Dispatched, EStepState::Skipped));
    CHECK_FALSE(CanChange(EStepState::Failed, EStepState::Skipped));
    CHECK(IsFinal(EStepState::Skipped));
    CHECK(CanChange(EJobState::Instructed, EJobState::InProgress));
    CHECK_FALSE(CanChange(EJobState::Instructed, EJobState::Completed));
    CHECK_FALSE(CanChange(EJobState::Pending, EJobState::Failed));
    CHECK(CanChange(ETscState::Auto, ETscState::Pausing));
    CHECK(CanChange(ETscState::Pausing, ETscState::Paused));
    CHECK(CanChange(ETscState::Paused, ETscState::Auto));
    CHECK_FALSE(CanChange(ETscState::Auto, ETscState::Paused));
    CHECK_FALSE(CanChange(ETscState::Paused, ETscState::Pausing));
}

TEST_CASE("3 States are spelt as in the document")
{
    CHECK(GetText(EPlanState::Cancelled) == "Cancelled");
    CHECK(GetText(EStepState::InProgress) == "InProgress");
    CHECK(GetText(EJobState::Instructed) == "Instructed");
    CHECK(GetText(ERobotStatus::UnDocking) == "UnDocking");
}
