#include "Catch.hpp"
#include "vda-sim/VehicleFactsheet.hpp"
#include "VehicleDriver.hpp"

#include <algorithm>
#include <chrono>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using VDA5050::ActionParameter;
using VDA5050::EActionStatus;
using VDA5050::EVda5050Version;
namespace ActionTypes = VDA5050::ActionTypes;

/// A vehicle at its charger.
VdaSim::VirtualVehicleOptions MakeMapOptions(EVda5050Version version)
{
    VdaSim::VirtualVehicleOptions options = VehicleDriver::MakeOptions("DOCK");
    options.version = version;
    return options;
}

/// The site of the tests with other maps of its nodes.
Planning::SiteMap MakeSiteOfMaps(const std::map<std::string, std::string>& mapIDs)
{
    const Planning::SiteMap site = MakeTestSite();
    std::vector<Planning::SiteNode> nodes = site.GetNodes();
    for (Planning::SiteNode& node : nodes)
    {
        if (const auto other = mapIDs.find(node.nodeID); other != mapIDs.end())
        {
            node.mapID = other->second;
        }
    }
    return VehicleDriver::Take(Planning::SiteMap::Create(std::move(nodes), site.GetEdges(), site.GetStations()));
}

/// Whether the vehicle accepts an order to N2, with this map of N2.
bool TryOrderTo(VehicleDriver& driver, const std::string& mapID)
{
    auto route = driver.MakeRoute("order-to-" + mapID, {"DOCK", "N2"});
    auto order = VehicleDriver::Take(route.MakeOrder(2));
    order.nodes[1].nodePosition->mapID = mapID;
    driver.Send(order);
    return driver.GetState().orderID == order.orderID;
}

} // namespace

TEST_CASE("6.8.2 Maps are downloaded, enabled and deleted, and a factsheet without a needed parameter refuses them")
{
    VehicleDriver driver(MakeMapOptions(EVda5050Version::Version210));
    const auto send = [&driver](std::string_view type, const std::string& actionID, const std::string& version) {
        driver.SendInstantly(
            type,
            actionID,
            {MakeText("mapId", "floor"),
             MakeText("mapVersion", version),
             MakeText("mapDownloadLink", "http://maps/2")});
        driver.Pass(2s);
    };
    const auto getMaps = [&driver]() {
        return driver.GetState().maps.value_or(std::vector<VDA5050::MapState>());
    };
    send(ActionTypes::DOWNLOAD_MAP, "download", "2");
    REQUIRE(getMaps().size() == 2);
    CHECK(getMaps()[1] == VDA5050::MapState{"floor", "2", VDA5050::EMapStatus::Disabled, {}});
    driver.SendInstantly(ActionTypes::ENABLE_MAP, "enable", {MakeText("mapId", "floor"), MakeText("mapVersion", "2")});
    driver.Pass(2s);
    CHECK(getMaps()[0].mapStatus == VDA5050::EMapStatus::Disabled);
    CHECK(getMaps()[1].mapStatus == VDA5050::EMapStatus::Enabled);
    driver.SendInstantly(ActionTypes::DELETE_MAP, "delete", {MakeText("mapId", "floor"), MakeText("mapVersion", "1")});
    driver.Pass(2s);
    REQUIRE(getMaps().size() == 1);
    CHECK(getMaps()[0].mapVersion == "2");
    driver.SendInstantly(ActionTypes::DELETE_MAP, "without", {MakeText("mapId", "floor")});
    driver.Pass(2s);
    CHECK(driver.GetStatus("without") == EActionStatus::Failed);
}

TEST_CASE("6.8.2 A vehicle of 2.0.0 has no map actions: they are new in 2.1.0")
{
    VehicleDriver driver(MakeMapOptions(EVda5050Version::Version200));
    const VDA5050::FactsheetMessage factsheet =
        VdaSim::MakeFactsheet(VdaSim::EVehicleType::Logistics, {}, EVda5050Version::Version200);
    for (const std::string_view type : {ActionTypes::ENABLE_MAP, ActionTypes::DOWNLOAD_MAP, ActionTypes::DELETE_MAP})
    {
        CAPTURE(type);
        CHECK_FALSE(VDA5050::CanPerform(factsheet, type, VDA5050::EActionScope::Instant));
        const std::string actionID = "map-" + std::string(type);
        driver.SendInstantly(type, actionID, {MakeText("mapId", "floor"), MakeText("mapVersion", "1")});
        driver.Pass(2s);
        CHECK(driver.GetStatus(actionID) == EActionStatus::Failed);
        const std::vector<VDA5050::VehicleError> errors = driver.GetState().errors;
        CHECK(std::ranges::any_of(errors, [&actionID](const VDA5050::VehicleError& error) {
            return error.errorType == VDA5050::ErrorTypes::INSTANT_ACTION_ERROR
                && HasReference(error, "actionId", actionID);
        }));
    }
}

TEST_CASE("6.6.4 An order with a map that is not on the site is refused, also if nodes of the site have no mapId")
{
    for (const EVda5050Version version : {EVda5050Version::Version200, EVda5050Version::Version210})
    {
        CAPTURE(static_cast<int>(version));
        VehicleDriver driver(MakeMapOptions(version), 1, MakeSiteOfMaps({{"N0", ""}}));
        CHECK_FALSE(TryOrderTo(driver, "cellar"));
        CHECK_FALSE(TryOrderTo(driver, ""));
        CHECK(TryOrderTo(driver, "floor"));
        VehicleDriver nowhere(MakeMapOptions(version), 1, MakeSiteOfMaps({{"DOCK", ""}}));
        CHECK_FALSE(TryOrderTo(nowhere, "cellar"));
        CHECK_FALSE(TryOrderTo(nowhere, "floor")); // its first node does not name the map
        VehicleDriver none(
            MakeMapOptions(version),
            1,
            MakeSiteOfMaps({{"N0", ""}, {"N1", ""}, {"N2", ""}, {"DOCK", ""}}));
        CHECK(TryOrderTo(none, "cellar"));
    }
}

TEST_CASE("7 A vehicle of 2.1.0 reports every map of its site, and accepts orders on these only")
{
    VehicleDriver driver(
        MakeMapOptions(EVda5050Version::Version210),
        1,
        MakeSiteOfMaps({{"N0", "roof"}, {"N2", "roof"}}));
    CHECK(
        driver.GetState().maps
        == std::vector<VDA5050::MapState>{
            {"floor", "1", VDA5050::EMapStatus::Enabled, {}},
            {"roof", "1", VDA5050::EMapStatus::Enabled, {}}});
    CHECK_FALSE(TryOrderTo(driver, "cellar"));
    REQUIRE(TryOrderTo(driver, "roof"));
    driver.Pass(60s);
    CHECK(driver.GetState().lastNodeID == "N2");
    CHECK(driver.GetState().agvPosition->mapID == "roof");
}

TEST_CASE("7 An order on a map that is DISABLED is refused, unless it enables the map")
{
    VehicleDriver driver(MakeMapOptions(EVda5050Version::Version210));
    const ActionParameter mapID = MakeText("mapId", "cellar");
    const ActionParameter version = MakeText("mapVersion", "1");
    driver.SendInstantly(
        ActionTypes::DOWNLOAD_MAP,
        "download",
        {mapID, version, MakeText("mapDownloadLink", "http://maps/2")});
    driver.Pass(2s);
    REQUIRE(driver.GetStatus("download") == EActionStatus::Finished);
    CHECK_FALSE(TryOrderTo(driver, "cellar"));
    REQUIRE(driver.GetState().errors.size() == 1);
    CHECK(driver.GetState().errors[0].errorType == VDA5050::ErrorTypes::ORDER_ERROR);
    CHECK(HasReference(driver.GetState().errors[0], "mapId", "cellar"));
    CHECK(HasReference(driver.GetState().errors[0], "nodeId", "N2"));

    // Enabled on the first node, used on the second, and extended before the action has ended.
    auto route = driver.MakeRoute("lift", {"DOCK", "N2", "DOCK"});
    auto order = VehicleDriver::Take(route.MakeOrder(2));
    VDA5050::Action enable;
    enable.actionType = ActionTypes::ENABLE_MAP;
    enable.actionID = "enable";
    enable.blockingType = VDA5050::EBlockingType::Hard;
    enable.actionParameters = {mapID, version};
    order.nodes[0].actions.push_back(enable);
    order.nodes[1].nodePosition->mapID = "cellar";
    driver.Send(order);
    CHECK(driver.GetState().orderID == "lift");
    auto update = VehicleDriver::Take(route.MakeUpdate(3));
    update.nodes[0].nodePosition->mapID = "cellar";
    driver.Send(update);
    CHECK(driver.GetState().orderUpdateID == 1);
    driver.Pass(60s);
    CHECK(driver.GetStatus("enable") == EActionStatus::Finished);
    CHECK(driver.GetState().errors.empty());
    CHECK(driver.GetState().lastNodeSequenceID == 4);
}

} // namespace ACS::Testing
