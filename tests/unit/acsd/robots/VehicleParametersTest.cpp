#include "robots/VehicleParameters.hpp"

#include "Catch.hpp"
#include "robots/DefaultParameters.hpp"
#include "robots/VehicleFixture.hpp"
#include <acs/vda5050/PredefinedActions.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

using VDA5050::EValueDataType;

const StationTable& GetStations()
{
    static const StationTable TABLE{
        {"A01.CP01", {{"type", std::string("rack")}, {"height", 0.8}, {"slot", std::int64_t{7}}}},
        {"A01.CP02", {{"type", std::string("floor")}}}};
    return TABLE;
}

Planning::StartJob MakeLoad(const std::string& place = "A01.CP01")
{
    Planning::StartJob job = MakeJob("CassetteLoad");
    job.from = place;
    job.to = "LR01.CP03";
    return job;
}

LoadPositions MakePositions()
{
    return {*Core::ParseLocationRange("LR01.CP01-04"), {{"CP03", "front"}}};
}

/// As of a table `parameters` with these lines.
std::vector<VehicleParameter> Parse(const std::string& lines)
{
    std::vector<VehicleParameter> parameters;
    const toml::table table = toml::parse(lines);
    for (auto&& [key, value] : table)
    {
        auto parsed = ParameterTemplate::Make(value);
        REQUIRE(parsed.has_value());
        parameters.push_back({std::string(key.str()), *parsed, false});
    }
    return parameters;
}

std::string Make(
    const JobMethod& method,
    const Planning::StartJob& job,
    const VDA5050::FactsheetMessage* factsheetOrNull = nullptr)
{
    const LoadPositions positions = MakePositions();
    const auto parameters = MakeActionParameters(method, JobData(job, GetStations(), positions), factsheetOrNull);
    if (!parameters.has_value())
    {
        return parameters.error();
    }
    std::string text;
    for (const VDA5050::ActionParameter& parameter : *parameters)
    {
        text += (text.empty() ? "" : " ") + parameter.key + "=" + parameter.value.GetText();
    }
    return text;
}

/// A vehicle whose action "lift" has these parameters.
VDA5050::FactsheetMessage MakeLiftFactsheet(const std::vector<VDA5050::AgvActionParameter>& parameters)
{
    VDA5050::FactsheetMessage factsheet;
    factsheet.protocolFeatures.agvActions.push_back({"lift", "", {VDA5050::EActionScope::Node}, parameters, "", {}});
    return factsheet;
}

const Planning::ActionRule& GetLoadRule()
{
    static const Planning::ActionRule RULE = Planning::MakeStandardActions().at("CassetteLoad");
    return RULE;
}

} // namespace

TEST_CASE(
    "The default pick has everything that the standard demands, and names the job's own place and the robot's port")
{
    const JobMethod pick{"pick", 0, MakeDefaultParameters("pick", GetLoadRule(), 4)};
    CHECK(
        Make(pick, MakeLoad())
        == R"(stationName="A01.CP01" loadId="C1" stationType="rack" loadType="cassette" lhd="front" height=0.8)");
    VDA5050::FactsheetMessage factsheet;
    factsheet.protocolFeatures.agvActions = VDA5050::GetPredefinedActions();
    CHECK(
        Make(pick, MakeLoad("A01.CP02"), &factsheet)
        == R"(stationName="A01.CP02" loadId="C1" stationType="floor" loadType="cassette" lhd="front")");
    const Planning::ActionRule tray = Planning::MakeStandardActions().at("TrayUnload");
    CHECK(
        Make({"drop", 0, MakeDefaultParameters("drop", tray, 4)}, MakeLoad()).find(R"(loadType="tray")")
        != std::string::npos);
    CHECK(
        Make({"detach", 0, MakeDefaultParameters("detach", GetLoadRule(), 4)}, MakeLoad())
        == R"(stationName="A01.CP01" loadId="C1")");
}

TEST_CASE("A default that the vehicle does not list is left out, but not the port of a robot that has several")
{
    VDA5050::FactsheetMessage factsheet;
    factsheet.protocolFeatures.agvActions.push_back(
        {"pick", "", {VDA5050::EActionScope::Node}, {{"stationName", EValueDataType::String, "", false}}, "", {}});
    CHECK(
        Make({"pick", 0, MakeDefaultParameters("pick", GetLoadRule(), 1)}, MakeLoad(), &factsheet)
        == R"(stationName="A01.CP01")");
    CHECK(
        Make({"pick", 0, MakeDefaultParameters("pick", GetLoadRule(), 4)}, MakeLoad(), &factsheet)
        == "the vehicle's factsheet does not list the parameter lhd of pick");
    factsheet.protocolFeatures.agvActions[0].actionParameters.clear();
    CHECK(
        Make({"pick", 0, MakeDefaultParameters("pick", GetLoadRule(), 4)}, MakeLoad(), &factsheet).find("loadType")
        != std::string::npos);
}

TEST_CASE("Without a factsheet values have their TOML type, a single name that of its value")
{
    const JobMethod method{
        "lift",
        0,
        Parse("a = 1\nb = 1.5\nc = true\nd = '{station.height}'\ne = 'at {station.height}'\nf = '{from.cp}'\n"
              "g = { x = 1, name = '{carrier}', list = ['{from.cp}', 2, []] }\n")};
    CHECK(Make(method, MakeLoad()) == R"(a=1 b=1.5 c=true d=0.8 e="at 0.8" f=1 g={"list":[1,2,[]],"name":"C1","x":1})");
}

TEST_CASE("A string in a table is escaped as JSON wants it")
{
    Planning::StartJob job = MakeLoad();
    job.carrierID = "a\"b\\c";
    CHECK(Make({"lift", 0, Parse("a = { b = 'x {carrier}' }")}, job) == R"(a={"b":"x a\"b\\c"})");
}

TEST_CASE("Values have the type that the factsheet declares")
{
    struct Row
    {
        std::string toml;
        EValueDataType type;
        std::string result;
    };
    const std::vector<Row> rows{
        {"a = 1", EValueDataType::String, R"(a="1")"},
        {"a = '{station.height}'", EValueDataType::String, R"(a="0.8")"},
        {"a = true", EValueDataType::String, R"(a="true")"},
        {"a = '0.5'", EValueDataType::Number, "a=0.5"},
        {"a = '0.5'", EValueDataType::Float, "a=0.5"},
        {"a = 3", EValueDataType::Number, "a=3"},
        {"a = '12'", EValueDataType::Integer, "a=12"},
        {"a = 2.0", EValueDataType::Integer, "a=2"},
        {"a = '{from.cp}'", EValueDataType::Integer, "a=1"},
        {"a = 'true'", EValueDataType::Bool, "a=true"},
        {"a = false", EValueDataType::Bool, "a=false"},
        {"a = { b = 1 }", EValueDataType::Object, R"(a={"b":1})"},
        {"a = [1, 'x']", EValueDataType::Array, R"(a=[1,"x"])"},
        {"a = 'rack'",
         EValueDataType::Number,
         R"(the parameter a of lift cannot be given: "rack" is not of type NUMBER)"},
        {"a = true", EValueDataType::Number, "the parameter a of lift cannot be given: true is not of type NUMBER"},
        {"a = 2.5", EValueDataType::Integer, "the parameter a of lift cannot be given: 2.5 is not of type INTEGER"},
        {"a = 1e300",
         EValueDataType::Integer,
         "the parameter a of lift cannot be given: 1e+300 is not of type INTEGER"},
        {"a = 1", EValueDataType::Bool, "the parameter a of lift cannot be given: 1 is not of type BOOL"},
        {"a = 'x'", EValueDataType::Object, R"(the parameter a of lift cannot be given: "x" is not of type OBJECT)"},
        {"a = [1]", EValueDataType::Object, "the parameter a of lift cannot be given: a list is not of type OBJECT"},
        {"a = { b = 1 }",
         EValueDataType::Array,
         "the parameter a of lift cannot be given: a table is not of type ARRAY"},
        {"a = { b = 1 }",
         EValueDataType::String,
         "the parameter a of lift cannot be given: a table is not of type STRING"}};
    for (const Row& row : rows)
    {
        INFO(row.toml << " " << row.result);
        VDA5050::FactsheetMessage factsheet = MakeLiftFactsheet({{"a", row.type, "", false}});
        CHECK(Make({"lift", 0, Parse(row.toml)}, MakeLoad(), &factsheet) == row.result);
        factsheet = MakeLiftFactsheet({{"a", row.type, "", true}});
        const bool bGiven = row.result.starts_with("a=");
        CHECK(Make({"lift", 0, Parse(row.toml)}, MakeLoad(), &factsheet) == (bGiven ? row.result : ""));
    }
}

TEST_CASE("An action or a configured parameter that the factsheet does not list is an error")
{
    const VDA5050::FactsheetMessage factsheet = MakeLiftFactsheet({{"height", EValueDataType::Float, "", true}});
    CHECK(
        Make({"pick", 0, Parse("height = 1.0")}, MakeLoad(), &factsheet)
        == "the vehicle's factsheet does not list pick");
    CHECK(
        Make({"lift", 0, Parse("depth = 1.0")}, MakeLoad(), &factsheet)
        == "the vehicle's factsheet does not list the parameter depth of lift");
    const VDA5050::FactsheetMessage silent;
    CHECK(Make({"lift", 0, Parse("depth = 1.0")}, MakeLoad(), &silent) == "depth=1");
}

TEST_CASE("An optional parameter without a value is left out, a mandatory one is an error")
{
    const JobMethod method{"lift", 0, Parse("height = '{station.height}'\nname = '{place}'")};
    CHECK(Make(method, MakeLoad("A01.CP02")) == R"(name="A01.CP02")");
    const auto make = [&method](std::optional<bool> bOptional) {
        const VDA5050::FactsheetMessage factsheet = MakeLiftFactsheet(
            {{"height", EValueDataType::Float, "", bOptional}, {"name", EValueDataType::String, "", true}});
        return Make(method, MakeLoad("A01.CP02"), &factsheet);
    };
    CHECK(make(true) == R"(name="A01.CP02")");
    const std::string reason = "the parameter height of lift cannot be given: the job has no {station.height}";
    CHECK(make(false) == reason);
    CHECK(make(std::nullopt) == reason); // the standard's default
}

TEST_CASE("A mandatory parameter of the factsheet that is not configured is an error, an optional one is not")
{
    VDA5050::FactsheetMessage factsheet =
        MakeLiftFactsheet({{"fork", EValueDataType::Integer, "", false}, {"speed", EValueDataType::Float, "", true}});
    CHECK(Make({"lift", 0, Parse("fork = 1")}, MakeLoad(), &factsheet) == "fork=1");
    CHECK(
        Make({"lift", 0, Parse("speed = 0.5")}, MakeLoad(), &factsheet)
        == "the parameter fork of lift is mandatory and not configured");
}

TEST_CASE("An action with more parameters than the factsheet allows is an error; defaults are left out first")
{
    VDA5050::FactsheetMessage factsheet;
    std::optional<std::uint32_t>& most = factsheet.protocolLimits.maxArrayLengths.actionParameters;
    const JobMethod lift{"lift", 0, Parse("a = 1\nb = 2")};
    most = 2;
    CHECK(Make(lift, MakeLoad(), &factsheet) == "a=1 b=2");
    most = 0; // no limit
    CHECK(Make(lift, MakeLoad(), &factsheet) == "a=1 b=2");
    most = 1;
    const std::string error =
        "lift has 2 parameters, and the factsheet allows 1 (maxArrayLens.actions.actionsParameters)";
    CHECK(Make(lift, MakeLoad(), &factsheet) == error);
    CHECK_FALSE(FindMethodFaultOrNull(lift, factsheet).has_value()); // a job may have no value for one of them
    const JobMethod sided{"lift", 0, Parse("a = 1\nb = '{station.slot}'")};
    CHECK(Make(sided, MakeLoad("A01.CP02"), &factsheet) == "a=1");
    factsheet.protocolFeatures =
        MakeLiftFactsheet({{"a", EValueDataType::Integer, "", false}, {"b", EValueDataType::Integer, "", false}})
            .protocolFeatures;
    CHECK(FindMethodFaultOrNull(lift, factsheet) == error);
    factsheet.protocolFeatures = MakeLiftFactsheet({}).protocolFeatures;

    const JobMethod detach{"detach", 0, MakeDefaultParameters("detach", GetLoadRule(), 1)};
    CHECK(Make(detach, MakeLoad()) == R"(stationName="A01.CP01" loadId="C1")");
    CHECK(Make(detach, MakeLoad(), &factsheet) == "the vehicle's factsheet does not list detach");
    factsheet.protocolFeatures.agvActions.clear();
    CHECK(Make(detach, MakeLoad(), &factsheet) == R"(stationName="A01.CP01")");
}

TEST_CASE("An action that the vehicle does not perform with the blocking type HARD is an error")
{
    VDA5050::FactsheetMessage factsheet = MakeLiftFactsheet({});
    const JobMethod lift{"lift", 0, Parse("a = 1")};
    std::vector<VDA5050::EBlockingType>& blockingTypes = factsheet.protocolFeatures.agvActions[0].blockingTypes;
    blockingTypes = {VDA5050::EBlockingType::Soft, VDA5050::EBlockingType::Hard};
    CHECK(Make(lift, MakeLoad(), &factsheet) == "a=1");
    blockingTypes.pop_back();
    const std::string error = "the vehicle's factsheet does not list lift with the blocking type HARD";
    CHECK(Make(lift, MakeLoad(), &factsheet) == error);
    CHECK(FindMethodFaultOrNull(lift, factsheet) == error);
}

TEST_CASE("Without a factsheet the standard defines what a pick needs")
{
    const JobMethod pick{"pick", 0, Parse("stationType = '{station.side}'\nloadType = 'cassette'")};
    CHECK(Make(pick, MakeLoad()) == "the parameter stationType of pick cannot be given: the job has no {station.side}");
}

} // namespace ACS::Acsd::Test
