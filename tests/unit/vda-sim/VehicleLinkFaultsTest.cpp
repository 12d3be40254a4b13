#include "Catch.hpp"
#include "VehicleDriver.hpp"

#include <optional>
#include <string>
#include <vector>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;

} // namespace

TEST_CASE("drop: the connection is cut with the will, the vehicle continues and reconnects by itself")
{
    VehicleDriver driver("N0");
    driver.SendRoute();
    driver.Pass(2s);
    driver.Inject("drop for=5s");
    CHECK_FALSE(driver.IsConnected());
    CHECK(driver.GetCuts() == std::vector<bool>{true});
    const std::size_t before = driver.GetPublished().size();
    const double place = driver.GetPose().x;
    driver.Pass(4900ms);
    CHECK(driver.GetPublished().size() == before);
    CHECK(driver.GetPose().x > place + 4.0);
    driver.Pass(200ms);
    CHECK(driver.IsConnected());
    REQUIRE(driver.GetPublished().size() > before);
    CHECK(driver.GetPublished()[before].second.topic == "uagv/v2/ACS/LR01/connection");
    CHECK_THAT(driver.GetPublished()[before].second.payload, Catch::Contains("\"ONLINE\""));
    driver.Pass(60s);
    CHECK(driver.GetState().lastNodeID == "N2");
    CHECK(driver.HasLine("fault begins", "drop for=5s"));
    CHECK(driver.HasLine("fault ended", "drop for=5s"));
}

TEST_CASE("drop will=no: the connection ends without a will; two drops end with the last of them")
{
    VehicleDriver driver("N0");
    driver.Inject("drop will=no for=2s");
    driver.Inject("drop for=5s");
    CHECK(driver.GetCuts() == std::vector<bool>{false, true});
    driver.Pass(3s);
    CHECK_FALSE(driver.IsConnected());
    driver.Pass(3s);
    CHECK(driver.IsConnected());
}

TEST_CASE("silence: nothing is published, and the vehicle works on")
{
    VehicleDriver driver("N0");
    driver.SendRoute();
    driver.Inject("silence for=8s");
    const std::size_t before = driver.GetPublished().size();
    driver.Pass(7900ms);
    CHECK(driver.GetPublished().size() == before);
    CHECK(driver.GetPose().x > 5.0);
    driver.Pass(1500ms);
    CHECK(driver.GetPublished().size() > before);
}

TEST_CASE("loss and delay: an order that is lost never comes, one that is held back comes late")
{
    VehicleDriver driver("N0");
    driver.Inject("loss topic=order for=1s");
    driver.SendRoute("lost");
    driver.Pass(1s);
    CHECK(driver.GetState().orderID.empty());
    driver.Inject("delay time=700ms direction=in");
    driver.SendRoute("late");
    driver.Pass(690ms);
    CHECK(driver.GetState().orderID.empty());
    driver.Pass(20ms);
    CHECK(driver.GetState().orderID == "late");
}

TEST_CASE("delay: what is published comes late and in its order; a vehicle that leaves holds nothing back")
{
    VehicleDriver driver("N0");
    driver.Inject("delay time=1s jitter=500ms direction=out");
    const std::size_t before = driver.GetPublished().size();
    driver.SendRoute();
    driver.Pass(950ms);
    CHECK(driver.GetPublished().size() == before);
    driver.Pass(8s);
    VDA5050::Vda5050Codec codec;
    std::optional<std::uint32_t> last;
    for (std::size_t i = before; i < driver.GetPublished().size(); ++i)
    {
        const VDA5050::MqttMessage& message = driver.GetPublished()[i].second;
        if (message.topic.ends_with("/state"))
        {
            const VDA5050::StateMessage state =
                VehicleDriver::Take(codec.Decode<VDA5050::StateMessage>(message.payload));
            CHECK((!last.has_value() || state.header.headerID == *last + 1));
            last = state.header.headerID;
        }
    }
    CHECK(last.has_value());
    driver.Leave();
    CHECK_THAT(driver.GetLast().payload, Catch::Contains("\"OFFLINE\""));
}

TEST_CASE("The same seed and the same messages give the same run, to the last byte")
{
    const auto run = [](std::uint64_t seed) {
        VehicleDriver driver(VehicleDriver::MakeOptions("N0"), seed);
        driver.Inject("loss percent=20");
        driver.Inject("delay time=50ms jitter=200ms direction=out");
        for (int i = 0; i < 20; ++i)
        {
            driver.SendRoute("order-" + std::to_string(i));
            driver.Pass(3s);
        }
        std::string all;
        for (const auto& [time, message] : driver.GetPublished())
        {
            all += std::to_string(time.time_since_epoch().count()) + message.topic + message.payload;
        }
        return all;
    };
    const std::string first = run(7);
    CHECK(first == run(7));
    CHECK(first != run(8));
}

} // namespace ACS::Testing
