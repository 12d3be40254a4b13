#include "robots/VehicleFixture.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

namespace ACS::Acsd::Test
{

TEST_CASE("6.7 Pause and Resume are the instant actions startPause and stopPause")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    vehicle.Command(Planning::Pause{});
    REQUIRE(vehicle.outputs.messages.size() == 1);
    CHECK(vehicle.outputs.messages[0].topic.ends_with("/instantActions"));
    CHECK(vehicle.outputs.messages[0].payload.find("\"startPause\"") != std::string::npos);
    vehicle.outputs.messages.clear();
    vehicle.Command(Planning::Resume{});
    REQUIRE_FALSE(vehicle.outputs.messages.empty());
    CHECK(vehicle.outputs.messages.back().payload.find("\"stopPause\"") != std::string::npos);
}

TEST_CASE("A command withdraws the former action of its kind that the vehicle has not shown, and no other one")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    vehicle.Command(Planning::StartCharging{});
    vehicle.Command(Planning::Pause{});
    vehicle.Command(Planning::Resume{});
    vehicle.Command(Planning::StartCharging{});
    vehicle.outputs.messages.clear();
    std::vector<std::string> resent;
    for (int round = 0; round < 4; ++round)
    {
        vehicle.clock.Advance(std::chrono::seconds(3));
        vehicle.adapter.OnTimer(
            static_cast<Planning::AdapterTimerID>(VDA5050::EMasterTimer::ResendInstantActions),
            vehicle.clock.GetNow(),
            vehicle.actions);
    }
    for (const auto& message : vehicle.outputs.messages)
    {
        const auto sent = vehicle.codec.Decode<VDA5050::InstantActionsMessage>(message.payload);
        REQUIRE(sent);
        for (const VDA5050::Action& action : sent->actions)
        {
            resent.push_back(action.actionType);
        }
    }
    CHECK(std::ranges::count(resent, "startPause") == 0);
    CHECK(std::ranges::count(resent, "stopPause") > 0);
    CHECK(std::ranges::count(resent, "startCharging") == std::ranges::count(resent, "stopPause"));
}

TEST_CASE("An instant action of acsd that lasts is no order of another master")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    vehicle.Command(Planning::StartCharging{});
    const auto sent = vehicle.codec.Decode<VDA5050::InstantActionsMessage>(vehicle.outputs.messages.back().payload);
    REQUIRE(sent);
    vehicle.state.orderID = "before";
    vehicle.state.actionStates = {
        {sent->actions.at(0).actionID, "startCharging", "", VDA5050::EActionStatus::Running, ""}};
    vehicle.ShowState();
    CHECK_FALSE(vehicle.TakeEvents<Planning::StateChanged>().back().bOccupied);
    vehicle.state.actionStates[0].actionID = "foreign";
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::StateChanged>().back().bOccupied);
}

TEST_CASE("StartCharging and StopCharging are the instant actions of these names")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    vehicle.Command(Planning::StartCharging{});
    REQUIRE(vehicle.outputs.messages.size() == 1);
    CHECK(vehicle.outputs.messages[0].topic.ends_with("/instantActions"));
    CHECK(vehicle.outputs.messages[0].payload.find("\"startCharging\"") != std::string::npos);
    vehicle.outputs.messages.clear();
    vehicle.Command(Planning::StopCharging{});
    REQUIRE_FALSE(vehicle.outputs.messages.empty());
    CHECK(vehicle.outputs.messages.back().payload.find("\"stopCharging\"") != std::string::npos);
}

TEST_CASE("6.7, D-22 A vehicle is paused when it reports that and the job's action does not run")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    vehicle.Command(MakeJob("CassetteLoad"));
    const auto orders = vehicle.TakeOrders();
    REQUIRE(orders.size() == 1);
    vehicle.ShowOrder(orders[0], {});
    vehicle.state.actionStates = {{"U1", "pick", "", VDA5050::EActionStatus::Running, ""}};
    vehicle.state.bPaused = true;
    vehicle.ShowState();
    CHECK_FALSE(vehicle.TakeEvents<Planning::StateChanged>().back().bPaused);
    vehicle.state.actionStates[0].actionStatus = VDA5050::EActionStatus::Paused;
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::StateChanged>().back().bPaused);
    vehicle.state.bPaused = false;
    vehicle.ShowState();
    CHECK_FALSE(vehicle.TakeEvents<Planning::StateChanged>().back().bPaused);
}

TEST_CASE("6.7 Without the member paused, the ends of startPause and stopPause decide whether the vehicle is paused")
{
    VehicleFixture vehicle;
    vehicle.ComeOnline();
    vehicle.state.bPaused.reset();
    vehicle.state.actionStates = {{"A1", "startPause", "", VDA5050::EActionStatus::Running, ""}};
    vehicle.ShowState();
    CHECK_FALSE(vehicle.TakeEvents<Planning::StateChanged>().back().bPaused);
    vehicle.state.actionStates[0].actionStatus = VDA5050::EActionStatus::Finished;
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::StateChanged>().back().bPaused);
    vehicle.state.actionStates.clear();
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::StateChanged>().back().bPaused);
    vehicle.state.actionStates = {{"A2", "stopPause", "", VDA5050::EActionStatus::Finished, ""}};
    vehicle.ShowState();
    CHECK_FALSE(vehicle.TakeEvents<Planning::StateChanged>().back().bPaused);
}

TEST_CASE("A vehicle without the map of its nodes has an error until it has enabled it at acsd's request")
{
    const Core::Result<Planning::SiteMap> site = Planning::SiteMap::Create(
        {{"A", 0, 0, "hall", {{"lr", {}}}}, {"B", 2, 0, "hall", {{"lr", {}}}}},
        {{"A-B", "A", "B", {{"lr", {}, {}, {}, {}, {}, {}}}}},
        {});
    REQUIRE(site);
    VDA5050::MasterOptions options = VehicleFixture::MakeOptions();
    options.version = VDA5050::EVda5050Version::Version210;
    VehicleFixture vehicle(
        JobMethods(),
        options,
        std::make_shared<DriveCheck>(VehicleMap(*site, "lr")),
        {{"hall", "2", {}, {}}});
    vehicle.state.header.version = "2.1.0";
    vehicle.state.maps = std::vector<VDA5050::MapState>{{"hall", "2", VDA5050::EMapStatus::Enabled, {}}};
    vehicle.ComeOnline();
    CHECK(vehicle.TakeEvents<Planning::StateChanged>().back().errors.empty());
    CHECK(vehicle.outputs.messages.empty());
    vehicle.state.maps->front().mapStatus = VDA5050::EMapStatus::Disabled;
    vehicle.ShowState();
    const auto states = vehicle.TakeEvents<Planning::StateChanged>();
    REQUIRE_FALSE(states.empty());
    REQUIRE(states.back().errors.size() == 1);
    CHECK(states.back().errors.front().errorCode == "AGV-mapNotEnabled");
    CHECK(states.back().errors.front().level == Planning::EAlarmLevel::Heavy);
    const auto sent = vehicle.codec.Decode<VDA5050::InstantActionsMessage>(vehicle.outputs.messages.back().payload);
    REQUIRE(sent);
    CHECK(sent->actions.at(0).actionType == "enableMap");
    const std::size_t count = vehicle.outputs.messages.size();
    CHECK(states.back().errors.front().message == "map hall version 2 is not enabled; it enables it now.");
    vehicle.state.actionStates = {{sent->actions[0].actionID, "enableMap", "", VDA5050::EActionStatus::Finished, ""}};
    vehicle.state.maps->front().mapStatus = VDA5050::EMapStatus::Enabled;
    vehicle.ShowState();
    CHECK(vehicle.TakeEvents<Planning::StateChanged>().back().errors.empty());
    CHECK(vehicle.outputs.messages.size() == count);
}

} // namespace ACS::Acsd::Test
