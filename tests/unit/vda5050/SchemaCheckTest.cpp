#include "SchemaCheck.hpp"

#include "Catch.hpp"

#include <string>

using namespace ACS; // NOLINT(google-build-using-namespace)
using Testing::FindSchemaFaultOrNull;
using VDA5050::ETopic;
using VDA5050::EVda5050Version;

namespace
{

/// A valid order after a replacement that makes it invalid.
std::string MakeOrder(const std::string& from = {}, const std::string& to = {})
{
    std::string text =
        R"({"headerId":1,"timestamp":"2026-11-20T23:37:12.345Z","version":"2.0.0","manufacturer":"KIT","serialNumber":"1",)"
        R"("orderId":"o","orderUpdateId":0,"nodes":[{"nodeId":"n","sequenceId":0,"released":true,"nodePosition":)"
        R"({"x":0,"y":0.5,"theta":3.1,"mapId":"m"},"actions":[{"actionType":"pick","actionId":"a","blockingType":"HARD",)"
        R"("actionParameters":[{"key":"k","value":{"free":[1]}}]}]}],"edges":[]})";
    if (!from.empty())
    {
        const std::size_t position = text.find(from);
        REQUIRE(position != std::string::npos);
        text.replace(position, from.size(), to);
    }
    return text;
}

} // namespace

TEST_CASE("1 The schemas of ACS_SPEC_DIR are there for all that is published in these tests")
{
    if (!Testing::HasSchemas())
    {
        WARN("skipped: ACS_SPEC_DIR does not name a folder with vda5050/schemas; nothing published here was validated");
        return;
    }
    CHECK(FindSchemaFaultOrNull(EVda5050Version::Version200, ETopic::Order, MakeOrder()) == std::nullopt);
    const std::string newer = MakeOrder("2.0.0", "2.1.0");
    CHECK(FindSchemaFaultOrNull(EVda5050Version::Version210, ETopic::Order, newer) == std::nullopt);
    Testing::CheckValid("uagv/v2/KIT/1/order", newer);
}

TEST_CASE("1 The schema check refuses each planted fault and names its place")
{
    if (!Testing::HasSchemas())
    {
        WARN("skipped: ACS_SPEC_DIR does not name a folder with vda5050/schemas");
        return;
    }
    struct Case
    {
        const char* from;
        const char* to;
        const char* fault;
    };
    const Case planted = GENERATE(
        Case{R"("orderId":"o",)", "", "# breaks required"},
        Case{R"("mapId":"m")", R"("mapDescription":"m")", "#/nodes/0/nodePosition breaks required"},
        Case{R"("actionId":"a",)", "", "#/nodes/0/actions/0 breaks required"},
        Case{R"("edges")", R"("vendor":1,"edges")", "breaks additionalProperties"},
        Case{R"("x":0,)", R"("x":0,"z":1,)", "breaks additionalProperties"},
        Case{R"("key":"k")", R"("key":"k","unit":"m")", "breaks additionalProperties"},
        Case{R"("actionType")", R"("actionName":"pick","actionType")", "breaks additionalProperties"},
        Case{R"("sequenceId":0)", R"("sequenceId":"0")", "#/nodes/0/sequenceId breaks type"},
        Case{R"("sequenceId":0)", R"("sequenceId":0.5)", "#/nodes/0/sequenceId breaks type"},
        Case{R"("released":true)", R"("released":null)", "#/nodes/0/released breaks type"},
        Case{R"({"free":[1]})", "null", "#/nodes/0/actions/0/actionParameters/0/value breaks type"},
        Case{R"("edges":[])", R"("edges":{})", "#/edges breaks type"},
        Case{R"("HARD")", R"("SINGLE")", "#/nodes/0/actions/0/blockingType breaks enum"},
        Case{R"("orderUpdateId":0)", R"("orderUpdateId":-1)", "#/orderUpdateId breaks minimum"},
        Case{R"("theta":3.1)", R"("theta":3.2)", "#/nodes/0/nodePosition/theta breaks maximum"},
        Case{R"("theta":3.1)", R"("theta":-4)", "#/nodes/0/nodePosition/theta breaks minimum"},
        Case{"2026-11-20T23:37:12.345Z", "yesterday", "#/timestamp is not a date-time"},
        Case{"2026-11-20T23:37:12.345Z", "2026-11-20T23:37:12.345", "#/timestamp is not a date-time"},
        Case{"2026-11-20T23:37:12.345Z", "2026-13-20T23:37:12Z", "#/timestamp is not a date-time"},
        Case{R"("version":"2.0.0")", R"("version":"2.1.0")", "#/version is not 2.0.0"},
        Case{R"("orderId":"o")", R"("orderId":"o","orderId":"p")", "the name orderId is repeated"},
        Case{R"("x":0)", R"("x":NaN)", "invalid JSON"},
        Case{R"("edges":[]})", R"("edges":[])", "invalid JSON"});
    const std::string text = MakeOrder(planted.from, planted.to);
    CAPTURE(text);
    const auto fault = FindSchemaFaultOrNull(EVda5050Version::Version200, ETopic::Order, text);
    REQUIRE(fault.has_value());
    CHECK_THAT(*fault, Catch::Contains(planted.fault));
}
