#include "Catch.hpp"
#include "TemporaryFolder.hpp"
#include "vda-sim/VehicleFactsheet.hpp"
#include "vda-sim/WorldWatch.hpp"
#include "VehicleDriver.hpp"
#include "world/EWorldError.hpp"
#include "world/MemoryWorld.hpp"
#include "world/WorldFile.hpp"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using Sim::MemoryWorld;
using VDA5050::ActionParameter;
using VDA5050::EActionStatus;

ActionParameter MakeParameter(std::string_view key, std::string_view value)
{
    return {std::string(key), Core::JsonText::FromString(value)};
}

/// A conforming pick or drop with these changes.
std::vector<ActionParameter> MakeParameters(std::string_view station, std::vector<ActionParameter> more = {})
{
    std::vector<ActionParameter> parameters{
        MakeParameter("stationType", "rack"),
        MakeParameter("stationName", station),
        MakeParameter("loadType", "cassette")};
    parameters.insert(parameters.end(), more.begin(), more.end());
    return parameters;
}

/// LR01 at N1, the dock of A01.CP01 and A01.CP02, over a world with a cassette at A01.CP01.
class WorldFixture
{
    MemoryWorld _world;
    VdaSim::VirtualVehicleOptions _options = VehicleDriver::MakeOptions("N1");
    int _orders = 0;

public:
    WorldFixture()
    {
        REQUIRE(_world.Act(Sim::CarrierPlaced{"CASSETTE_01", "A01.CP01"}));
        _options.worldOrNull = &_world;
    }

    [[nodiscard]] MemoryWorld& GetWorld() noexcept
    {
        return _world;
    }

    [[nodiscard]] VdaSim::VirtualVehicleOptions& GetOptions() noexcept
    {
        return _options;
    }

    /// Sends an order with one action on its last node and returns how that ended.
    [[nodiscard]] VDA5050::ActionState Perform(
        VehicleDriver& driver,
        std::string_view actionType,
        std::vector<ActionParameter> parameters,
        const std::vector<std::string>& nodeIDs = {"N1"})
    {
        ++_orders;
        auto route = driver.MakeRoute("order-" + std::to_string(_orders), nodeIDs);
        auto order = VehicleDriver::Take(route.MakeOrder(nodeIDs.size()));
        VDA5050::Action action;
        action.actionType = std::string(actionType);
        action.actionID = "action-" + std::to_string(_orders);
        action.blockingType = VDA5050::EBlockingType::Hard;
        action.actionParameters = std::move(parameters);
        const std::string actionID = action.actionID;
        order.nodes.back().actions.push_back(std::move(action));
        driver.Send(std::move(order));
        driver.Pass(60s);
        for (const VDA5050::ActionState& state : driver.GetState().actionStates)
        {
            if (state.actionID == actionID)
            {
                return state;
            }
        }
        FAIL(
            "the order was refused: "
            << (driver.GetState().errors.empty() ? "" : driver.GetState().errors[0].errorDescription));
        return {};
    }
};

/// A world whose journal another process keeps locked at first.
class LockedWorld final : public Sim::IWorld
{
    Sim::IWorld& _floor;
    bool _bLocked = true;

public:
    explicit LockedWorld(Sim::IWorld& floor)
        : _floor(floor)
    {
    }

    void Unlock() noexcept
    {
        _bLocked = false;
    }

    [[nodiscard]] Core::Result<void> Act(const Sim::WorldEvent& event) override
    {
        return _bLocked ? Core::Fail(Sim::EWorldError::JournalFailed) : _floor.Act(event);
    }

    [[nodiscard]] std::optional<std::string> GetCarrierOrNull(std::string_view place) override
    {
        return _floor.GetCarrierOrNull(place);
    }

    [[nodiscard]] std::optional<std::string> GetPlaceOrNull(std::string_view carrierID) override
    {
        return _floor.GetPlaceOrNull(carrierID);
    }

    [[nodiscard]] Sim::EMemory GetMemory(std::string_view place) override
    {
        return _floor.GetMemory(place);
    }

    [[nodiscard]] bool IsCovered(std::string_view set) override
    {
        return _floor.IsCovered(set);
    }

    [[nodiscard]] std::vector<Sim::WorldEvent> TakeEvents() override
    {
        return _floor.TakeEvents();
    }
};

/// "CP01=CASSETTE_01 ": what the state shows on board.
std::string ListLoads(const VehicleDriver& driver)
{
    std::string list;
    for (const VDA5050::Load& load : driver.GetState().loads.value_or(std::vector<VDA5050::Load>()))
    {
        list += load.loadPosition + "=" + load.loadID.value_or("?") + " ";
    }
    return list;
}

} // namespace

TEST_CASE("A vehicle moves the carrier of the place that its action names to the port that it names, and back")
{
    WorldFixture floor;
    VehicleDriver driver(floor.GetOptions());
    CHECK(driver.GetState().loads->empty());
    const auto picked = floor.Perform(
        driver,
        "pick",
        MakeParameters("A01.CP01", {MakeParameter("loadId", "CASSETTE_01"), MakeParameter("lhd", "CP03")}));
    CHECK(picked.actionStatus == EActionStatus::Finished);
    CHECK(floor.GetWorld().GetPlaceOrNull("CASSETTE_01") == "LR01.CP03");
    CHECK(ListLoads(driver) == "CP03=CASSETTE_01 ");
    CHECK(driver.GetState().loads->front().loadType == "cassette");

    const auto dropped = floor.Perform(driver, "drop", MakeParameters("A01.CP02", {MakeParameter("lhd", "CP03")}));
    CHECK(dropped.actionStatus == EActionStatus::Finished);
    CHECK(floor.GetWorld().GetPlaceOrNull("CASSETTE_01") == "A01.CP02");
    CHECK(driver.GetState().loads->empty());
}

TEST_CASE("What is physically impossible fails with a reason, and nothing moves")
{
    WorldFixture floor;
    REQUIRE(floor.GetWorld().Act(Sim::CarrierPlaced{"CASSETTE_02", "LR01.CP02"}));
    VehicleDriver driver(floor.GetOptions());
    CHECK(ListLoads(driver) == "CP02=CASSETTE_02 "); // as in the world file
    struct Impossible
    {
        const char* actionType;
        std::vector<ActionParameter> parameters;
        const char* reason;
    };
    for (const Impossible& impossible : {
             Impossible{"pick", MakeParameters("A01.CP02"), "empty place"},
             Impossible{"pick", MakeParameters("A01.CP01", {MakeParameter("loadId", "CASSETTE_07")}), "CASSETTE_07"},
             Impossible{
                 "pick",
                 MakeParameters("A01.CP01", {MakeParameter("lhd", "CP02")}),
                 "load position is occupied"},
             Impossible{"pick", MakeParameters("A01.CP01", {MakeParameter("lhd", "CP05")}), "no such load position"},
             Impossible{"pick", MakeParameters("A02.CP01"), "docked at"},
             Impossible{"pick", MakeParameters("nowhere"), "place"},
             Impossible{"pick", MakeParameters(""), "no station"},
             Impossible{"drop", MakeParameters("A01.CP01", {MakeParameter("loadId", "CASSETTE_02")}), "free place"},
             Impossible{"drop", MakeParameters("A01.CP02", {MakeParameter("loadId", "CASSETTE_01")}), "not on board"},
             Impossible{"drop", MakeParameters("A01.CP02", {MakeParameter("lhd", "CP01")}), "not on board"},
             Impossible{
                 "drop",
                 MakeParameters("A01.CP02", {MakeParameter("loadId", "CASSETTE_02"), MakeParameter("lhd", "CP01")}),
                 "another load position"},
         })
    {
        const auto ended = floor.Perform(driver, impossible.actionType, impossible.parameters);
        CHECK(ended.actionStatus == EActionStatus::Failed);
        CHECK_THAT(ended.resultDescription, Catch::Contains(impossible.reason));
        CHECK(floor.GetWorld().GetPlaceOrNull("CASSETTE_01") == "A01.CP01");
        CHECK(floor.GetWorld().GetPlaceOrNull("CASSETTE_02") == "LR01.CP02");
    }
}

TEST_CASE("An action that fails by a fault moves nothing")
{
    WorldFixture floor;
    VehicleDriver driver(floor.GetOptions());
    driver.Inject("action-fails");
    CHECK(floor.Perform(driver, "pick", MakeParameters("A01.CP01")).actionStatus == EActionStatus::Failed);
    CHECK(floor.GetWorld().GetPlaceOrNull("CASSETTE_01") == "A01.CP01");
    CHECK(driver.GetState().loads->empty());
}

TEST_CASE("Without a stationName the only station of the node is used")
{
    WorldFixture floor;
    REQUIRE(floor.GetWorld().Act(Sim::CarrierPlaced{"CASSETTE_02", "A02.CP01"}));
    floor.GetOptions().startNodeID = "N2";
    VehicleDriver driver(floor.GetOptions());
    const auto picked = floor.Perform(
        driver,
        "pick",
        {MakeParameter("stationType", "rack"), MakeParameter("loadType", "cassette")},
        {"N2"});
    CHECK(picked.actionStatus == EActionStatus::Finished);
    CHECK(ListLoads(driver) == "CP01=CASSETTE_02 ");
}

TEST_CASE("A vehicle docks at all stations of the node where it is stationary, and leaves them when it drives off")
{
    WorldFixture floor;
    floor.GetOptions().startNodeID = "N0";
    VehicleDriver driver(floor.GetOptions());
    CHECK(floor.GetWorld().TakeEvents().size() == 1); // the cassette: no robot has docked
    static_cast<void>(floor.Perform(driver, "finePositioning", {}, {"N0", "N1"}));
    std::vector<Sim::WorldEvent> events = floor.GetWorld().TakeEvents();
    REQUIRE(events.size() == 1);
    CHECK((events[0] == Sim::WorldEvent(Sim::RobotDocked{"LR01", {"A01.CP01", "A01.CP02"}})));
    static_cast<void>(floor.Perform(driver, "finePositioning", {}, {"N1", "N2"}));
    events = floor.GetWorld().TakeEvents();
    REQUIRE(events.size() == 2);
    CHECK((events[0] == Sim::WorldEvent(Sim::RobotDocked{"LR01", {}})));
    CHECK((events[1] == Sim::WorldEvent(Sim::RobotDocked{"LR01", {"A02.CP01"}})));
}

TEST_CASE("A vehicle that stops between two nodes has left its stations")
{
    WorldFixture floor;
    VehicleDriver driver(floor.GetOptions());
    driver.Pass(1s);
    static_cast<void>(floor.GetWorld().TakeEvents());
    auto route = driver.MakeRoute("order-1", {"N1", "N2"});
    driver.Send(VehicleDriver::Take(route.MakeOrder(2)));
    driver.Pass(2s);
    driver.Inject("mode");
    driver.Pass(5s);
    REQUIRE_FALSE(driver.GetState().bDriving);
    const auto events = floor.GetWorld().TakeEvents();
    CHECK(events == std::vector<Sim::WorldEvent>{Sim::RobotDocked{"LR01", {}}});
}

TEST_CASE("A vehicle that drives through a node does not dock there")
{
    WorldFixture floor;
    floor.GetOptions().startNodeID = "N0";
    VehicleDriver driver(floor.GetOptions());
    static_cast<void>(floor.GetWorld().TakeEvents());
    static_cast<void>(floor.Perform(driver, "finePositioning", {}, {"N0", "N1", "N2"}));
    const std::vector<Sim::WorldEvent> events = floor.GetWorld().TakeEvents();
    REQUIRE(events.size() == 1);
    CHECK((events[0] == Sim::WorldEvent(Sim::RobotDocked{"LR01", {"A02.CP01"}})));
}

TEST_CASE("A vehicle that initPosition puts elsewhere has left its stations")
{
    WorldFixture floor;
    VehicleDriver driver(floor.GetOptions());
    static_cast<void>(floor.GetWorld().TakeEvents());
    const auto place = [&driver](const char* actionID, double x, double y) {
        driver.SendInstantly(
            "initPosition",
            actionID,
            {{"x", Core::JsonText::FromNumber(x)},
             {"y", Core::JsonText::FromNumber(y)},
             {"theta", Core::JsonText::FromNumber(0.0)},
             MakeParameter("mapId", "floor"),
             MakeParameter("lastNodeId", "N1")});
        driver.Pass(5s);
    };
    place("away", 5.0, 0.0);
    place("back", 10.1, 0.0);
    const std::vector<Sim::WorldEvent> events = floor.GetWorld().TakeEvents();
    REQUIRE(events.size() == 2);
    CHECK((events[0] == Sim::WorldEvent(Sim::RobotDocked{"LR01", {}})));
    CHECK((events[1] == Sim::WorldEvent(Sim::RobotDocked{"LR01", {"A01.CP01", "A01.CP02"}})));
}

TEST_CASE("A journal that cannot be read fails pick and drop with file and line, in the action and in the log")
{
    const TemporaryFolder folder;
    const std::string file = folder.GetPath() / "world.json";
    std::ofstream(file) << R"({"version":1,"carriers":{"CASSETTE_01":"A01.CP01","CASSETTE_02":"LR01.CP02"}})";
    const auto world = Sim::WorldFile::Open(file);
    REQUIRE(world.has_value());
    WorldFixture floor;
    floor.GetOptions().worldOrNull = world->get();
    VehicleDriver driver(floor.GetOptions());
    std::ofstream(file + ".journal", std::ios::app) << "no JSON\n";
    const std::string place = file + ".journal:2: ";
    for (const char* actionType : {"pick", "drop"})
    {
        const auto ended = floor.Perform(driver, actionType, MakeParameters("A01.CP01"));
        CHECK(ended.actionStatus == EActionStatus::Failed);
        CHECK_THAT(ended.resultDescription, Catch::StartsWith(place));
        CHECK(std::ranges::any_of(driver.GetLog().GetLines(), [&ended](const RecordedLine& line) {
            return line.message == "action failed" && line.HasField("actionId", ended.actionID)
                && line.HasField("reason", ended.resultDescription);
        }));
    }
    CHECK((*world)->GetPlaceOrNull("CASSETTE_01") == "A01.CP01");
}

TEST_CASE("The log has when the world becomes unreadable and when it is readable again")
{
    const TemporaryFolder folder;
    const std::string file = folder.GetPath() / "world.json";
    std::ofstream(file) << R"({"version":1})";
    const auto world = Sim::WorldFile::Open(file);
    REQUIRE(world.has_value());
    RecordingLogSink log;
    VdaSim::WorldWatch watch(**world, Core::Logger(log, "vda-sim"));
    CHECK_FALSE(watch.HasChanged());
    REQUIRE((*world)->Act(Sim::CarrierPlaced{"CASSETTE_01", "A01.CP01"}));
    CHECK(watch.HasChanged());
    CHECK(log.GetLines().empty());
    const auto whole = std::filesystem::file_size(file + ".journal");
    std::ofstream(file + ".journal", std::ios::app) << "no JSON\n";
    CHECK_FALSE(watch.HasChanged());
    CHECK_FALSE(watch.HasChanged());
    REQUIRE(log.GetLines().size() == 1);
    CHECK(log.GetLines()[0].level == Core::ELogLevel::Error);
    CHECK_THAT(log.GetLines()[0].fields[0].second, Catch::StartsWith(file + ".journal:2: "));
    std::filesystem::resize_file(file + ".journal", whole);
    CHECK_FALSE(watch.HasChanged());
    CHECK(log.GetLines().size() == 2);
}

TEST_CASE("A docking that could not be recorded in the world is recorded later")
{
    WorldFixture floor;
    LockedWorld world(floor.GetWorld());
    floor.GetOptions().worldOrNull = &world;
    static_cast<void>(floor.GetWorld().TakeEvents());
    VehicleDriver driver(floor.GetOptions());
    driver.Pass(1s);
    CHECK(floor.GetWorld().TakeEvents().empty());
    CHECK(driver.GetLog().Contains(Core::ELogLevel::Warning, "cannot record in the world where the vehicle is docked"));
    world.Unlock();
    driver.Pass(1s);
    const std::vector<Sim::WorldEvent> events = floor.GetWorld().TakeEvents();
    REQUIRE(events.size() == 1);
    CHECK((events[0] == Sim::WorldEvent(Sim::RobotDocked{"LR01", {"A01.CP01", "A01.CP02"}})));
}

TEST_CASE("Loads that another program puts on the vehicle are in its state")
{
    WorldFixture floor;
    VehicleDriver driver(floor.GetOptions());
    REQUIRE(floor.GetWorld().Act(Sim::CarrierPlaced{"CASSETTE_05", "LR01.CP04"}));
    driver.NoteWorldChanged();
    CHECK(ListLoads(driver) == "CP04=CASSETTE_05 ");
}

TEST_CASE("Custom load handling: other actionTypes, parameters and names of the load positions")
{
    WorldFixture floor;
    const auto spec = VdaSim::ParseVehicleSpec(
        "LR01,ports=2,load=CP01:front,load=CP02:7,pick=loadCassette,drop=unloadCassette,stationName=rack,"
        "lhd=gripper,loadId=barcode,stationType=,height=level:INTEGER");
    REQUIRE(spec.has_value());
    floor.GetOptions().handling = spec->handling;
    VehicleDriver driver(floor.GetOptions());
    const auto picked = floor.Perform(
        driver,
        "loadCassette",
        {MakeParameter("rack", "A01.CP01"),
         MakeParameter("gripper", "7"),
         MakeParameter("barcode", "CASSETTE_01"),
         MakeParameter("loadType", "cassette")});
    CHECK(picked.actionStatus == EActionStatus::Finished);
    CHECK(floor.GetWorld().GetPlaceOrNull("CASSETTE_01") == "LR01.CP02");
    CHECK(ListLoads(driver) == "7=CASSETTE_01 ");
    const auto dropped =
        floor.Perform(driver, "unloadCassette", {MakeParameter("rack", "A01.CP02"), MakeParameter("gripper", "7")});
    CHECK(dropped.actionStatus == EActionStatus::Finished);
    CHECK(floor.GetWorld().GetPlaceOrNull("CASSETTE_01") == "A01.CP02");
}

TEST_CASE("The factsheet lists custom load handling")
{
    const auto spec =
        VdaSim::ParseVehicleSpec("LR02,ports=1,load=CP01:front,pick=loadCassette,stationType=,height=level:INTEGER");
    REQUIRE(spec.has_value());
    const VDA5050::FactsheetMessage factsheet = VdaSim::MakeFactsheet(
        VdaSim::EVehicleType::Logistics,
        {},
        VDA5050::EVda5050Version::Version210,
        spec->handling);
    CHECK(factsheet.loadSpecification.loadPositions == std::vector<std::string>{"front"});
    CHECK(factsheet.protocolLimits.maxArrayLengths.stateLoads == 1U);
    const auto& actions = factsheet.protocolFeatures.agvActions;
    CHECK(std::ranges::find(actions, "pick", &VDA5050::AgvAction::actionType) == actions.end());
    CHECK(std::ranges::find(actions, "drop", &VDA5050::AgvAction::actionType) != actions.end());
    const auto pick = std::ranges::find(actions, "loadCassette", &VDA5050::AgvAction::actionType);
    REQUIRE(pick != actions.end());
    const auto& parameters = pick->actionParameters;
    const auto find = [&parameters](std::string_view key) {
        return std::ranges::find(parameters, key, &VDA5050::AgvActionParameter::key);
    };
    CHECK(find("stationType") == parameters.end());
    CHECK(find("height") == parameters.end());
    REQUIRE(find("level") != parameters.end());
    CHECK(find("level")->valueDataType == VDA5050::EValueDataType::Integer);
}

} // namespace ACS::Testing
