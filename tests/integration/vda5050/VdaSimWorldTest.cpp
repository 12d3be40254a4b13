#include "TemporaryFolder.hpp"
#include "VdaSimFixture.hpp"
#include "world/WorldFile.hpp"

#include <csignal>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Testing
{
namespace
{

/// A pick at A01.CP01, on whose node the vehicle is stationary.
VDA5050::OrderMessage MakePick(const std::string& orderID, const std::string& loadID)
{
    VDA5050::OrderNode node;
    node.nodeID = "D-A01.CP01";
    VDA5050::Action pick;
    pick.actionType = "pick";
    pick.actionID = orderID + "-pick";
    pick.blockingType = VDA5050::EBlockingType::Hard;
    const std::vector<std::pair<std::string, std::string>> parameters{
        {"stationType", "rack"},
        {"stationName", "A01.CP01"},
        {"loadType", "cassette"},
        {"loadId", loadID},
        {"lhd", "CP02"}};
    for (const auto& [key, value] : parameters)
    {
        pick.actionParameters.push_back({key, Core::JsonText::FromString(value)});
    }
    node.actions.push_back(std::move(pick));
    auto builder = VDA5050::OrderBuilder::Create(orderID, {std::move(node)}, {});
    REQUIRE(builder.has_value());
    auto order = builder->MakeOrder(1);
    REQUIRE(order.has_value());
    order->header.version = "2.0.0";
    order->header.manufacturer = "ACS";
    order->header.serialNumber = "LR01";
    return std::move(*order);
}

std::vector<std::string> MakeWorldCommand(const std::string& broker, const std::string& world)
{
    std::vector<std::string> command = MakeCommand(broker, ACS_SITE_FILE, "LR01,node=D-A01.CP01");
    command.insert(command.end(), {"--world", world});
    return command;
}

} // namespace

TEST_CASE_METHOD(VdaSimFixture, "vda-sim: moves the carriers of a world that another process shares")
{
    const TemporaryFolder folder;
    const std::string path = folder.GetPath() / "world.json";
    std::ofstream(path) << R"({"version":1,"carriers":{"CASSETTE_01":"A01.CP01","CASSETTE_02":"LR01.CP01"}})";
    auto world = Sim::WorldFile::Open(path);
    REQUIRE(world.has_value());
    ChildProcess program(MakeWorldCommand(_broker.GetURL(), path));
    const auto getEnd = [this](const std::string& actionID) {
        for (const VDA5050::ActionState& action : GetLastState().actionStates)
        {
            if (action.actionID == actionID && action.actionStatus >= VDA5050::EActionStatus::Finished)
            {
                return std::optional(action);
            }
        }
        return std::optional<VDA5050::ActionState>();
    };
    const auto countLoads = [this]() {
        return GetLastState().loads.value_or(std::vector<VDA5050::Load>()).size();
    };
    REQUIRE(TryRunUntil(_context, [&]() { return countLoads() == 1; }));

    Send(MakePick("wrong", "CASSETTE_09"));
    REQUIRE(TryRunUntil(_context, [&]() { return getEnd("wrong-pick").has_value(); }));
    CHECK(getEnd("wrong-pick")->actionStatus == VDA5050::EActionStatus::Failed);
    CHECK_THAT(getEnd("wrong-pick")->resultDescription, Catch::Contains("CASSETTE_09"));

    Send(MakePick("right", "CASSETTE_01"));
    REQUIRE(TryRunUntil(_context, [&]() { return getEnd("right-pick").has_value(); }));
    CHECK(getEnd("right-pick")->actionStatus == VDA5050::EActionStatus::Finished);
    CHECK((*world)->GetPlaceOrNull("CASSETTE_01") == "LR01.CP02");
    CHECK(countLoads() == 2);
    const std::vector<Sim::WorldEvent> events = (*world)->TakeEvents();
    REQUIRE(events.size() == 2);
    CHECK((events[0] == Sim::WorldEvent(Sim::RobotDocked{"LR01", {"A01.CP01"}})));
    CHECK((events[1] == Sim::WorldEvent(Sim::CarrierMoved{"LR01", "CASSETTE_01", "A01.CP01", "LR01.CP02"})));

    REQUIRE((*world)->Act(Sim::CarrierPlaced{"CASSETTE_02", ""}));
    CHECK(TryRunUntil(_context, [&]() { return countLoads() == 1; }));
    program.Signal(SIGTERM);
    CHECK(program.WaitForExitOrNull(PATIENCE) == 0);
}

TEST_CASE("vda-sim: an error in a world file is one line with file and position, and exit code 2")
{
    const TemporaryFolder folder;
    const std::string path = folder.GetPath() / "world.json";
    std::ofstream(path) << R"({"version":1,"carriers":{"CASSETTE_01":"A01"}})";
    ChildProcess program(MakeWorldCommand("mqtt://127.0.0.1:1883", path));
    CHECK(program.WaitForExitOrNull(PATIENCE) == 2);
    CHECK_THAT(program.GetText(), Catch::Contains("world.json: carriers.CASSETTE_01"));
    CHECK(std::ranges::count(program.GetText(), '\n') == 1);
}

} // namespace ACS::Testing
