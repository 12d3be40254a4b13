#include "robots/VehicleReport.hpp"

#include "Catch.hpp"
#include <acs/vda5050/PredefinedActions.hpp>

#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

struct ReportFixture
{
    LoadPositions positions;
    VDA5050::StateMessage state;
    VehicleReport report;

    void Update(bool bJobRunning = false)
    {
        report.Update(state, bJobRunning, positions);
    }

    void Finish(std::string_view actionType)
    {
        state.actionStates = {{"P", std::string(actionType), "", VDA5050::EActionStatus::Finished, ""}};
        Update();
    }
};

} // namespace

TEST_CASE("A position that the latest state omits is lost, one of a visualization message is kept")
{
    ReportFixture vehicle;
    VDA5050::AgvPosition position;
    position.x = 2;
    position.bPositionInitialized = true;
    vehicle.report.OnPosition(position);
    vehicle.Update();
    CHECK(vehicle.report.GetState().bPoseKnown);
    vehicle.state.agvPosition = position;
    vehicle.Update();
    CHECK(vehicle.report.GetState().bPoseKnown);
    CHECK(vehicle.report.GetState().x == 2);
    vehicle.state.agvPosition.reset();
    vehicle.Update();
    CHECK_FALSE(vehicle.report.GetState().bPoseKnown);
}

TEST_CASE("A coordinate that no site has, and a position that is not initialized, are unknown")
{
    ReportFixture vehicle;
    VDA5050::AgvPosition& position = vehicle.state.agvPosition.emplace();
    position.bPositionInitialized = true;
    position.y = 2e7;
    vehicle.Update();
    CHECK_FALSE(vehicle.report.GetState().bPoseKnown);
    position.y = 0;
    vehicle.Update();
    CHECK(vehicle.report.GetState().bPoseKnown);
    position.bPositionInitialized = false;
    vehicle.Update();
    CHECK_FALSE(vehicle.report.GetState().bPoseKnown);
}

TEST_CASE("A vehicle is paused as its state reports, or between startPause and stopPause where its state does not")
{
    ReportFixture vehicle;
    vehicle.Update();
    CHECK_FALSE(vehicle.report.GetState().bPaused);
    vehicle.Finish(VDA5050::ActionTypes::START_PAUSE);
    CHECK(vehicle.report.GetState().bPaused);
    vehicle.state.actionStates.clear();
    vehicle.Update();
    CHECK(vehicle.report.GetState().bPaused);
    vehicle.state.bPaused = false;
    vehicle.Update();
    CHECK_FALSE(vehicle.report.GetState().bPaused);
    vehicle.state.bPaused.reset();
    vehicle.Finish(VDA5050::ActionTypes::STOP_PAUSE);
    CHECK_FALSE(vehicle.report.GetState().bPaused);
}

TEST_CASE("A vehicle is not paused while the action of its job runs")
{
    ReportFixture vehicle;
    vehicle.state.bPaused = true;
    vehicle.Update(true);
    CHECK_FALSE(vehicle.report.GetState().bPaused);
    vehicle.Update(false);
    CHECK(vehicle.report.GetState().bPaused);
}

TEST_CASE("Only an occupied vehicle keeps nodes, and only the released ones")
{
    ReportFixture vehicle;
    vehicle.state.nodeStates = {{"B", 2, "", true, std::nullopt}, {"C", 4, "", false, std::nullopt}};
    vehicle.report.SetOccupied(true, vehicle.state);
    CHECK(vehicle.report.GetState().bOccupied);
    CHECK(vehicle.report.GetState().heldNodeIDs == std::vector<std::string>{"B"});
    vehicle.report.SetOccupied(false, vehicle.state);
    CHECK(vehicle.report.GetState().heldNodeIDs.empty());
}

TEST_CASE("A fatal error of a vehicle is a heavy one, and the list is that of the latest state")
{
    ReportFixture vehicle;
    vehicle.state.errors.emplace_back().errorType = "lidar";
    vehicle.state.errors.back().errorLevel = VDA5050::EErrorLevel::Fatal;
    vehicle.Update();
    REQUIRE(vehicle.report.GetState().errors.size() == 1);
    CHECK(vehicle.report.GetState().errors[0].errorCode == "AGV-lidar");
    CHECK(vehicle.report.GetState().errors[0].level == Planning::EAlarmLevel::Heavy);
    vehicle.state.errors.clear();
    vehicle.Update();
    CHECK(vehicle.report.GetState().errors.empty());
}

} // namespace ACS::Acsd::Test
