#include "Catch.hpp"
#include <acs/vda5050/EVda5050Error.hpp>
#include <acs/vda5050/EVda5050Version.hpp>
#include <acs/vda5050/QosTable.hpp>

namespace ACS::VDA5050::Test
{

TEST_CASE("2 A topic is interfaceName/v2/manufacturer/serialNumber/topic, built and parsed")
{
    const VehicleAddress address{"uagv", "KIT", "0001"};
    CHECK(BuildTopic(address, ETopic::InstantActions) == "uagv/v2/KIT/0001/instantActions");
    const auto parsed = ParseTopic("uagv/v2/KIT/0001/instantActions");
    REQUIRE(parsed.has_value());
    CHECK(*parsed == ParsedTopic{address, ETopic::InstantActions});
    CHECK(BuildTopicFilter("uagv", ETopic::Connection) == "uagv/v2/+/+/connection");
}

TEST_CASE("2 Other topics are refused")
{
    const char* text = GENERATE(
        "",
        "/",
        "uagv/v2/KIT/0001",
        "uagv/v2/KIT/0001/order/x",
        "uagv/v2/KIT//order",
        "uagv/v2/KIT/0001/orders",
        "uagv/v2/+/0001/order",
        "uagv/v2/KIT/#/order",
        "uagv/v2/KIT/00\n01/order",
        "$SYS/v2/KIT/0001/order");
    const auto parsed = ParseTopic(text);
    REQUIRE_FALSE(parsed.has_value());
    CHECK(parsed.error().code == EVda5050Error::InvalidTopic);
}

TEST_CASE("2 Another major version is recognised")
{
    const auto parsed = ParseTopic("vda5050/v3/KIT/0001/order");
    REQUIRE_FALSE(parsed.has_value());
    CHECK(parsed.error().code == EVda5050Error::UnsupportedVersion);
    CHECK(ReadVersionOrNull("2.0.0") == EVda5050Version::Version200);
    CHECK(ReadVersionOrNull("2.1") == EVda5050Version::Version210);
    CHECK(ReadVersionOrNull("2.7.3") == EVda5050Version::Version210);
    CHECK_FALSE(ReadVersionOrNull("3.0.0").has_value());
    CHECK_FALSE(ReadVersionOrNull("").has_value());
}

TEST_CASE("2 A level of an address contains no separator and no wildcard")
{
    CHECK(IsValidAddress({"uagv", "KIT", "0001"}));
    CHECK_FALSE(IsValidAddress({"uagv", "K/T", "0001"}));
    CHECK_FALSE(IsValidAddress({"uagv", "KIT", ""}));
    CHECK_FALSE(IsValidAddress({"uagv", "KIT", "+"}));
    CHECK_FALSE(IsValidAddress({"uagv", "KIT", "00\x01"}));
    CHECK_FALSE(IsValidAddress({"uagv", "KIT\x7F", "0001"}));
    CHECK_FALSE(IsValidAddress({"$SYS", "KIT", "0001"}));
    CHECK(IsValidAddress({"uagv", "K$T", "M\xC3\xBCller"}));
}

TEST_CASE("2 Quality of service: the project's profile, the standard's, and single topics set")
{
    QosTable project;
    CHECK(project.Get(ETopic::Order) == 2);
    CHECK(project.Get(ETopic::InstantActions) == 2);
    CHECK(project.Get(ETopic::State) == 1);
    CHECK(project.Get(ETopic::Connection) == 1);
    CHECK(project.Get(ETopic::Visualization) == 0);
    const QosTable standard(EQosProfile::Standard);
    CHECK(standard.Get(ETopic::Order) == 0);
    CHECK(standard.Get(ETopic::State) == 0);
    CHECK(standard.Get(ETopic::Connection) == 1);
    project.Set(ETopic::State, 2);
    CHECK(project.Get(ETopic::State) == 2);
    CHECK(IsRetained(ETopic::Connection));
    CHECK(IsRetained(ETopic::Factsheet));
    CHECK_FALSE(IsRetained(ETopic::Order));
    CHECK_FALSE(IsRetained(ETopic::InstantActions));
}

} // namespace ACS::VDA5050::Test
