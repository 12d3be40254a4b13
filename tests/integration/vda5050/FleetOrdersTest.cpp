#include "FleetOrders.hpp"

#include "Catch.hpp"
#include "TemporaryFolder.hpp"
#include "Vda5050Sample.hpp"

namespace ACS::Testing
{

using namespace VDA5050;       // NOLINT(google-build-using-namespace)
using namespace VDA5050::Test; // NOLINT(google-build-using-namespace)

TEST_CASE("13 The journal of a fleet master does not repeat a cancel that the vehicle has refused")
{
    const TemporaryFolder folder;
    const std::string journal = (folder.GetPath() / "journal").string();
    const std::string vehicle = "ACS/LR01";
    OrderMessage route = MakeOrder(5, 5);
    route.header.version = "2.0.0";
    const auto isCancelAsked = [&] {
        FleetOrders orders;
        REQUIRE(orders.TryOpen(journal));
        return orders.GetFirstOrNull(vehicle)->bCancelAsked;
    };
    {
        FleetOrders orders;
        REQUIRE(orders.TryOpen(journal));
        REQUIRE(orders.Take(vehicle, Vda5050Codec().Encode(route, EVda5050Version::Version200)).has_value());
        REQUIRE(orders.TryAskCancel(vehicle));
    }
    CHECK(isCancelAsked());
    {
        FleetOrders orders;
        REQUIRE(orders.TryOpen(journal));
        REQUIRE(orders.TryForgetCancel(vehicle));
        CHECK_FALSE(orders.GetFirstOrNull(vehicle)->bCancelAsked);
    }
    CHECK_FALSE(isCancelAsked());
}

TEST_CASE("13 The journal of a fleet master resumes an order without the update that its vehicle has rejected")
{
    const TemporaryFolder folder;
    const std::string journal = (folder.GetPath() / "journal").string();
    const std::string vehicle = "ACS/LR01";
    OrderMessage route = MakeOrder(5, 5);
    route.header.version = "2.0.0";
    {
        FleetOrders orders;
        REQUIRE(orders.TryOpen(journal));
        REQUIRE(orders.Take(vehicle, Vda5050Codec().Encode(route, EVda5050Version::Version200)).has_value());
        REQUIRE(orders.TryRelease(vehicle, 2));
        REQUIRE(orders.TryAccept(vehicle, 0));
        REQUIRE(orders.TryRelease(vehicle, 4));
        REQUIRE(orders.TryReject(vehicle, 1));
        REQUIRE(orders.TryRelease(vehicle, 3));
    }
    FleetOrders orders;
    REQUIRE(orders.TryOpen(journal));
    const std::vector<OrderMessage>& messages = orders.GetFirstOrNull(vehicle)->record.messages;
    REQUIRE(messages.size() == 2);
    CHECK(messages[1].orderUpdateID == 2);
    CHECK(messages[1].nodes.front().nodeID == "N1");
}

} // namespace ACS::Testing
