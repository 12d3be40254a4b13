#include "EarlyMessages.hpp"

#include "Catch.hpp"

#include <string>

namespace ACS::VDA5050
{

TEST_CASE("Early messages are delivered in their order, within limits of count and bytes")
{
    EarlyMessages early({3, 20});
    early.Add({"t", "1"});
    early.Add({"t", std::string(18, 'x')}); // 19 bytes of 18 that are left
    early.Add({"t", std::string(17, 'x')});
    early.Add({"", ""});
    early.Add({"", ""}); // the fourth
    CHECK(early.GetDropped() == 2);
    const std::vector<MqttMessage> taken = early.TakeAll();
    REQUIRE(taken.size() == 3);
    CHECK(taken[0].payload == "1");
    CHECK(taken[1].payload.size() == 17);
    CHECK(early.TakeAll().empty());
    early.Add({"t", std::string(19, 'x')}); // the room is free again
    CHECK(early.TakeAll().size() == 1);
}

TEST_CASE("Another attempt keeps early messages only where the broker does not send them again")
{
    EarlyMessages early({1, 100});
    early.Add({"t", "1"});
    early.Add({"t", "2"});
    early.OnAttempt(true);
    CHECK(early.GetDropped() == 0);
    early.Add({"t", "3"});
    CHECK(early.GetDropped() == 1);
    early.OnAttempt(false);
    early.Add({"t", "4"});
    CHECK(early.GetDropped() == 0);
    CHECK(early.TakeAll().at(0).payload == "4");
}

} // namespace ACS::VDA5050
