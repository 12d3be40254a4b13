#include "robots/VehicleMaps.hpp"

#include "Catch.hpp"

#include <string>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

using VDA5050::EMapStatus;
using VDA5050::MapState;

const NeededMap HALL{"hall", "2", "http://files/hall-2.zip", "abc"};

std::string GetText(const VDA5050::Action& action, const std::string& key)
{
    for (const VDA5050::ActionParameter& parameter : action.actionParameters)
    {
        if (parameter.key == key)
        {
            return std::string(parameter.value.GetText());
        }
    }
    return {};
}

} // namespace

TEST_CASE("A vehicle that reports no maps, or has its map enabled, has no error and no request")
{
    VehicleMaps maps({HALL, {"yard", {}, {}, {}}});
    CHECK(maps.ListErrors().empty());
    CHECK_FALSE(maps.MakeRequestOrNull().has_value());
    maps.OnReported(std::vector<MapState>{
        {"hall", "1", EMapStatus::Disabled, {}},
        {"hall", "2", EMapStatus::Enabled, {}},
        {"yard", "7", EMapStatus::Enabled, {}}});
    CHECK(maps.ListErrors().empty());
    CHECK_FALSE(maps.MakeRequestOrNull().has_value());
}

TEST_CASE("A missing map is downloaded, then enabled, each once; until then the vehicle has an error")
{
    VehicleMaps maps({HALL});
    maps.OnReported(std::vector<MapState>{{"hall", "1", EMapStatus::Enabled, {}}}); // another version
    const auto download = maps.MakeRequestOrNull();
    REQUIRE(download.has_value());
    CHECK(download->actionType == "downloadMap");
    CHECK(GetText(*download, "mapId") == R"("hall")");
    CHECK(GetText(*download, "mapVersion") == R"("2")");
    CHECK(GetText(*download, "mapDownloadLink") == R"("http://files/hall-2.zip")");
    CHECK(GetText(*download, "mapHash") == R"("abc")");
    maps.OnSent("A1");
    CHECK_FALSE(maps.MakeRequestOrNull().has_value());
    REQUIRE(maps.ListErrors().size() == 1);
    CHECK(maps.ListErrors().front().level == Planning::EAlarmLevel::Heavy);
    CHECK(maps.ListErrors().front().message == "map hall version 2 is not on the vehicle; it downloads it now.");
    maps.TryEnd("other", "failed");
    CHECK_FALSE(maps.MakeRequestOrNull().has_value());
    maps.TryEnd("A1", {});
    maps.OnReported(std::vector<MapState>{{"hall", "2", EMapStatus::Disabled, {}}});
    const auto enable = maps.MakeRequestOrNull();
    REQUIRE(enable.has_value());
    CHECK(enable->actionType == "enableMap");
    CHECK(GetText(*enable, "mapVersion") == R"("2")");
    CHECK(GetText(*enable, "mapDownloadLink").empty());
    maps.OnSent("A2");
    maps.OnReported(std::vector<MapState>{{"hall", "2", EMapStatus::Enabled, {}}});
    CHECK(maps.ListErrors().empty());
}

TEST_CASE(
    "A map that could not be downloaded is not tried again before the next connection, and the error has the reason")
{
    VehicleMaps maps({HALL});
    maps.OnReported(std::vector<MapState>());
    maps.OnSent("A1");
    maps.TryEnd("A1", "no such file");
    CHECK_FALSE(maps.MakeRequestOrNull().has_value());
    CHECK(
        maps.ListErrors().front().message
        == "map hall version 2 is not on the vehicle, and the vehicle could not download it: no such file. Enable it at the "
           "vehicle, or correct the maps of the robot in the configuration.");
    maps.OnConnected();
    CHECK(maps.MakeRequestOrNull().has_value());
}

TEST_CASE("A vehicle that reports a map as enabled and does not show it is asked three times")
{
    VehicleMaps maps({HALL});
    for (int request = 0; request < 3; ++request)
    {
        maps.OnReported(std::vector<MapState>{{"hall", "2", EMapStatus::Disabled, {}}});
        REQUIRE(maps.MakeRequestOrNull().has_value());
        maps.OnSent("A1");
        CHECK(maps.TryEnd("A1", {}));
    }
    maps.OnReported(std::vector<MapState>{{"hall", "2", EMapStatus::Disabled, {}}});
    CHECK_FALSE(maps.MakeRequestOrNull().has_value());
    CHECK(
        maps.ListErrors().front().message
        == "map hall version 2 is not enabled, and the vehicle could not enable it: it reported 3 times that it has, and does "
           "not show it in its state. Enable it at the vehicle, or correct the maps of the robot in the configuration.");
    maps.OnConnected();
    CHECK(maps.MakeRequestOrNull().has_value());
}

TEST_CASE("A map without a version or a link is neither enabled nor downloaded")
{
    VehicleMaps maps({{"hall", {}, {}, {}}, {"yard", "3", {}, {}}});
    maps.OnReported(std::vector<MapState>{{"hall", "1", EMapStatus::Disabled, {}}});
    CHECK_FALSE(maps.MakeRequestOrNull().has_value());
    REQUIRE(maps.ListErrors().size() == 2);
    CHECK(maps.ListErrors().front().message.starts_with("map hall is not enabled. Enable it"));
    CHECK(maps.ListErrors().back().message.starts_with("map yard version 3 is not on the vehicle. Enable it"));
}

} // namespace ACS::Acsd::Test
