#include "plans/RobotNaming.hpp"

#include "Catch.hpp"
#include "plans/SamplePlans.hpp"
#include "wire/Profile.hpp"

#include <string>
#include <vector>

using namespace ACS::McsSim; // NOLINT(google-build-using-namespace)
using ACS::Protocol::ERobotType;

namespace
{

void Tell(RobotBoard& board, const std::string& robotID, ERobotType type)
{
    ACS::Protocol::RobotStatusUpdate update;
    update.robotID = robotID;
    update.robotType = type;
    std::vector<std::string> lines;
    board.OnStatus(update, lines);
}

} // namespace

TEST_CASE("12 A generated plan names its ports by a robot of the type that its actions need")
{
    ACS::Protocol::ExecutionPlan plan = ACS::Testing::MakeSamplePlan("P", "T").plan;
    RobotBoard board;
    CHECK(NeedsRobot(plan));
    Tell(board, "CR01", ERobotType::Control);
    CHECK_FALSE(ChooseRobotOrNull(plan, board, 0).has_value());
    Tell(board, "LR01", ERobotType::Logistics);
    Tell(board, "LR02", ERobotType::Logistics);
    CHECK(ChooseRobotOrNull(plan, board, 0) == "LR01");
    CHECK(ChooseRobotOrNull(plan, board, 3) == "LR02");
    NameRobot(plan, "LR02");
    CHECK_FALSE(NeedsRobot(plan));
    CHECK(plan.steps[0].jobs[0].from == "LR02.CP01");
    CHECK(plan.steps[0].jobs[0].to == "A02.CP03");
    plan.steps = {{1, "TrayLoad", "A01.CP01", {}, {{"J", "A01.CP01.TP01", "AMRX.TP01"}}}};
    CHECK_FALSE(NeedsRobot(plan));
    CHECK(ChooseRobotOrNull(plan, board, 5) == "CR01");
}

TEST_CASE("12 The profile nexus behaves like the public MCS, the profile spec as specified")
{
    const McsBehaviour nexus = MakeBehaviour(EProfile::Nexus);
    CHECK(nexus.finalChunkBytes == 4096);
    CHECK((nexus.bErrorsUnanswered && nexus.bPositionsUnknown && nexus.bNullResults));
    CHECK(MakeBehaviour(EProfile::Spec) == McsBehaviour{});
}
