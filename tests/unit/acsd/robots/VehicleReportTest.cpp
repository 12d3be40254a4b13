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

TEST_CASE("19.5 of 10,000 errors 100 are kept, the fatal ones first, one of each type; the others are counted")
{
    constexpr std::size_t FLOOD = 10'000;
    constexpr std::size_t KEPT = 100;
    ReportFixture vehicle;
    for (std::size_t i = 0; i < FLOOD; ++i)
    {
        vehicle.state.errors.push_back({"e" + std::to_string(i), {}, "", "", VDA5050::EErrorLevel::Warning});
    }
    vehicle.state.errors.push_back({"e9", {}, "the same again", "", VDA5050::EErrorLevel::Fatal});
    vehicle.state.errors.push_back({"last", {}, std::string(FLOOD, 'x'), "", VDA5050::EErrorLevel::Fatal});
    vehicle.Update();
    const Planning::StateChanged& state = vehicle.report.GetState();
    REQUIRE(state.errors.size() == KEPT);
    CHECK(state.omittedErrors == FLOOD + 1 - KEPT);
    CHECK(state.errors[0] == Planning::RobotError{"AGV-e9", Planning::EAlarmLevel::Heavy, "the same again"});
    CHECK(state.errors[1].errorCode == "AGV-last");
    CHECK(state.errors[1].message.size() < 300);
    CHECK(state.errors[2].errorCode == "AGV-e0");

    vehicle.state.errors.resize(2);
    vehicle.Update();
    CHECK(state.errors.size() == 2);
    CHECK(state.omittedErrors == 0);
}

} // namespace ACS::Acsd::Test
