#include "Catch.hpp"
#include "MessageSample.hpp"
#include <acs/core/ECoreError.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <limits>
#include <string>

namespace ACS::VDA5050::Test
{

TEST_CASE("3 Members that 2.0 does not define are not written in 2.0")
{
    Vda5050Codec codec;
    const auto order = codec.Decode<OrderMessage>(ReadFull(ETopic::Order, EVda5050Version::Version210));
    REQUIRE(order.has_value());
    CHECK(codec.Encode(*order, EVda5050Version::Version200).find("corridor") == std::string::npos);
    const auto state = codec.Decode<StateMessage>(ReadFull(ETopic::State, EVda5050Version::Version210));
    REQUIRE(state.has_value());
    const std::string old = codec.Encode(*state, EVda5050Version::Version200);
    CHECK(old.find("maps") == std::string::npos);
    CHECK(old.find("errorHint") == std::string::npos);
    auto factsheet = codec.Decode<FactsheetMessage>(ReadFull(ETopic::Factsheet, EVda5050Version::Version210));
    REQUIRE(factsheet.has_value());
    factsheet->physicalParameters.angularSpeedMax = 1.5;
    CHECK(codec.Encode(*factsheet, EVda5050Version::Version210).find("angularSpeedMax") != std::string::npos);
    const std::string oldFactsheet = codec.Encode(*factsheet, EVda5050Version::Version200);
    CHECK(oldFactsheet.find("angularSpeedMax") == std::string::npos);
    CHECK(oldFactsheet.find("vehicleConfig") == std::string::npos);
    CHECK(oldFactsheet.find("blockingTypes") == std::string::npos);
}

TEST_CASE("1 Numbers are written as the schemas bound them: angles within pi, batteryHealth whole in 2.0")
{
    Vda5050Codec codec;
    const std::string order = ReadFull(ETopic::Order, EVda5050Version::Version210);
    const auto turned = codec.Decode<OrderMessage>(Replace(order, R"("theta":1.5)", R"("theta":3.1415927410125732)"));
    REQUIRE(turned.has_value());
    CHECK(
        codec.Encode(*turned, EVda5050Version::Version210)
        == Replace(order, R"("theta":1.5)", R"("theta":3.141592653589793)"));
    StateMessage state;
    state.batteryState.batteryHealth = 97.6;
    state.agvPosition.emplace().localizationScore = 1.0000001;
    CHECK_THAT(
        codec.Encode(state, EVda5050Version::Version200),
        Catch::Contains(R"("batteryHealth":98,)") && Catch::Contains(R"("localizationScore":1})"));
    CHECK_THAT(codec.Encode(state, EVda5050Version::Version210), Catch::Contains(R"("batteryHealth":97.6,)"));
}

TEST_CASE("6.2 No number is made up for one that is not finite: null, or the member is left out")
{
    const Vda5050Codec codec;
    const double noNumber = GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
    StateMessage state;
    state.batteryState.batteryCharge = noNumber;
    state.batteryState.batteryHealth = noNumber;
    state.agvPosition.emplace().theta = noNumber;
    state.agvPosition->localizationScore = noNumber;
    const std::string text = codec.Encode(state, EVda5050Version::Version200);
    CHECK_THAT(text, Catch::Contains(R"("batteryCharge":null,)") && Catch::Contains(R"("theta":null)"));
    CHECK_THAT(text, !Catch::Contains("batteryHealth") && !Catch::Contains("localizationScore"));
    CHECK_FALSE(Vda5050Codec().Decode<StateMessage>(text).has_value());
}

TEST_CASE("1 The misspellings of the published schemas are read")
{
    Vda5050Codec codec;
    const std::string order = ReadFull(ETopic::Order, EVda5050Version::Version200);
    const auto spelt = codec.Decode<OrderMessage>(Replace(order, "allowedDeviationXY", "allowedDeviationXy"));
    REQUIRE(spelt.has_value());
    CHECK(*spelt == *codec.Decode<OrderMessage>(order));
    const std::string instant = ReadFull(ETopic::InstantActions, EVda5050Version::Version200);
    const auto named = codec.Decode<InstantActionsMessage>(Replace(instant, "actionType", "actionName"));
    REQUIRE(named.has_value());
    CHECK(*named == *codec.Decode<InstantActionsMessage>(instant));
    const auto older = codec.Decode<InstantActionsMessage>(Replace(instant, "\"actions\"", "\"instantActions\""));
    REQUIRE(older.has_value());
    CHECK(*older == *named);
    const std::string factsheet = ReadFull(ETopic::Factsheet, EVda5050Version::Version200);
    const auto weighed = codec.Decode<FactsheetMessage>(Replace(
        Replace(factsheet, "maxWeight", "maxWeigth"),
        "information.infoReferences",
        "informations.infoReferences"));
    REQUIRE(weighed.has_value());
    CHECK(*weighed == *codec.Decode<FactsheetMessage>(factsheet));
}

TEST_CASE("2 Timestamps are read with any fraction and offset, and written with milliseconds")
{
    const std::string text = ReadFull(ETopic::Connection, EVda5050Version::Version200);
    const char* time = GENERATE(
        "2026-11-20T23:37:12.345Z",
        "2026-11-20T23:37:12.34500Z",
        "2026-11-21T08:37:12.345+09:00",
        "2026-11-20T23:37:12.345");
    Vda5050Codec codec;
    const auto message = codec.Decode<ConnectionMessage>(Replace(text, "2026-11-20T23:37:12.345Z", time));
    REQUIRE(message.has_value());
    CHECK(codec.Encode(*message, EVda5050Version::Version200) == text);
}

TEST_CASE("12 Unknown members are ignored and counted; null is absent where a member may be, wrong where it must be")
{
    Vda5050Codec codec;
    const std::string text = ReadFull(ETopic::Connection, EVda5050Version::Version200);
    REQUIRE(codec.Decode<ConnectionMessage>(Replace(text, "{", R"({"vendor":{"a":[1]},)")).has_value());
    CHECK(codec.GetTolerance().unknownMembers == 1);
    const std::string order = ReadFull(ETopic::Order, EVda5050Version::Version200);
    REQUIRE(codec.Decode<OrderMessage>(Replace(order, R"("maxSpeed":1.5)", R"("maxSpeed":null)")).has_value());
    CHECK(codec.GetTolerance().nullOptionals == 1);
    const auto failed = codec.Decode<OrderMessage>(Replace(order, R"("released":true)", R"("released":null)"));
    REQUIRE_FALSE(failed.has_value());
    CHECK(failed.error().path == "nodes[0].released");
}

TEST_CASE("3 A wrong payload is rejected with the path of the member and what is valid")
{
    struct Case
    {
        const char* from;
        const char* to;
        const char* path;
        Core::ECoreError code;
    };
    const Case wrong = GENERATE(
        Case{R"("sequenceId":0)", R"("sequenceId":-1)", "nodes[0].sequenceId", Core::ECoreError::OutOfRange},
        Case{R"("sequenceId":0)", R"("sequenceId":4294967296)", "nodes[0].sequenceId", Core::ECoreError::OutOfRange},
        Case{R"("sequenceId":0)", R"("sequenceId":"0")", "nodes[0].sequenceId", Core::ECoreError::WrongType},
        Case{R"("x":0.5)", R"("x":"0.5")", "nodes[0].nodePosition.x", Core::ECoreError::WrongType},
        Case{R"("theta":1.5)", R"("theta":4)", "nodes[0].nodePosition.theta", Core::ECoreError::OutOfRange},
        Case{
            R"("blockingType":"HARD")",
            R"("blockingType":"SINGLE")",
            "nodes[0].actions[0].blockingType",
            Core::ECoreError::UnknownWord},
        Case{R"("orderId":"order-1",)", "", "orderId", Core::ECoreError::MissingField},
        Case{"2026-11-20T23:37:12.345Z", "yesterday", "timestamp", Core::ECoreError::InvalidTimestamp});
    Vda5050Codec codec;
    const auto message =
        codec.Decode<OrderMessage>(Replace(ReadFull(ETopic::Order, EVda5050Version::Version200), wrong.from, wrong.to));
    REQUIRE_FALSE(message.has_value());
    CHECK(message.error().path == wrong.path);
    CHECK(message.error().code == wrong.code);
}

TEST_CASE("3 The header and ids of a rejected message are read as far as possible")
{
    Vda5050Codec codec;
    const auto identity = codec.DecodeIdentity(R"({"headerId":7,"orderId":"o","orderUpdateId":2,"nodes":5})");
    REQUIRE(identity.has_value());
    CHECK(identity->header.headerID == 7);
    CHECK(identity->orderID == "o");
    CHECK(identity->orderUpdateID == 2U);
    CHECK_FALSE(codec.DecodeIdentity("[").has_value());
}

TEST_CASE("3 Deep nesting and long payloads are rejected without being parsed")
{
    Vda5050Codec codec(CodecLimits{1000, 16});
    CHECK(codec.Decode<OrderMessage>(std::string(900, '[')).error().code != Core::ECoreError::MissingField);
    CHECK(codec.Decode<OrderMessage>(std::string(2000, ' ')).error().code == Core::ECoreError::TooLarge);
}

} // namespace ACS::VDA5050::Test
