#include "robots/InstantActionCheck.hpp"

#include "robots/VehicleFixture.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

using VDA5050::EValueDataType;
using VDA5050::EVda5050Version;

constexpr std::string_view OF_20 = "factsheetRequest initPosition logReport stateRequest";
constexpr std::string_view OF_21 =
    "deleteMap downloadMap enableMap factsheetRequest initPosition logReport stateRequest";

std::string ListTypes(const InstantActionCheck& check, const VDA5050::FactsheetMessage* factsheetOrNull)
{
    std::string types;
    for (const RobotActionOffer& offer : check.ListOffers(factsheetOrNull))
    {
        types += (types.empty() ? "" : " ") + offer.actionType;
    }
    return types;
}

InstantActionCheck MakeCheck(EVda5050Version version = EVda5050Version::Version210)
{
    return InstantActionCheck(JobMethods{{"CassetteLoad", {"pick", 0}}}, version);
}

RobotActionRequest MakePositionRequest()
{
    return {
        "initPosition",
        {{"x", Core::JsonText::FromNumber(1.5)},
         {"y", Core::JsonText::FromInteger(2)},
         {"theta", Core::JsonText::FromNumber(0)},
         {"mapId", Core::JsonText::FromString("floor-1")},
         {"lastNodeId", Core::JsonText::FromString("A")}}};
}

/// A factsheet with one action, whose parameters have every type.
VDA5050::FactsheetMessage MakeFactsheet()
{
    VDA5050::FactsheetMessage factsheet;
    VDA5050::AgvAction& beep = factsheet.protocolFeatures.agvActions.emplace_back();
    beep.actionType = "beep";
    beep.actionDescription = "sounds a horn";
    beep.actionScopes = {VDA5050::EActionScope::Node, VDA5050::EActionScope::Instant};
    for (const auto& [key, type] :
         {std::pair("b", EValueDataType::Bool),
          std::pair("n", EValueDataType::Number),
          std::pair("f", EValueDataType::Float),
          std::pair("i", EValueDataType::Integer),
          std::pair("s", EValueDataType::String),
          std::pair("o", EValueDataType::Object),
          std::pair("a", EValueDataType::Array)})
    {
        beep.actionParameters.push_back({key, type, {}, true});
    }
    return factsheet;
}

} // namespace

TEST_CASE("Without a factsheet a vehicle offers the instant actions of its version that acsd does not send itself")
{
    CHECK(ListTypes(MakeCheck(EVda5050Version::Version200), nullptr) == OF_20);
    CHECK(ListTypes(MakeCheck(EVda5050Version::Version210), nullptr) == OF_21);
    const VDA5050::FactsheetMessage empty;
    CHECK(ListTypes(MakeCheck(EVda5050Version::Version210), &empty) == OF_21);
    const StandardFactsheet standard;
    CHECK(ListTypes(MakeCheck(), &standard.factsheet) == OF_21);
}

TEST_CASE("A factsheet decides which instant actions a vehicle offers; it always has the two requests")
{
    VDA5050::FactsheetMessage factsheet = MakeFactsheet();
    factsheet.protocolFeatures.agvActions.front().actionParameters.push_back(
        {"b", EValueDataType::Number, {}, false});                                                  // a second b
    factsheet.protocolFeatures.agvActions.push_back(factsheet.protocolFeatures.agvActions.front()); // a second entry
    factsheet.protocolFeatures.agvActions.push_back({"dance", {}, {VDA5050::EActionScope::Node}, {}, {}, {}});
    const InstantActionCheck check = MakeCheck();
    CHECK(ListTypes(check, &factsheet) == "beep factsheetRequest stateRequest");
    const RobotActionOffer offer = check.ListOffers(&factsheet).front();
    CHECK(offer.description == "sounds a horn");
    CHECK(offer.parameters.size() == 7);
    CHECK(offer.parameters.front() == RobotParameterOffer{"b", "BOOL", false});
    CHECK(check.ListOffers(nullptr).back().parameters.empty());
    CHECK(
        check.FindErrorOrNull({"initPosition", {}}, &factsheet)
        == R"(The robot has no instant action "initPosition". It has: beep, factsheetRequest, stateRequest.)");
    CHECK(check.FindErrorOrNull({"dance", {}}, &factsheet).has_value()); // on nodes only
}

TEST_CASE("The parameters of a predefined action are those of the standard unless the factsheet lists them")
{
    const InstantActionCheck check = MakeCheck();
    StandardFactsheet standard;
    const bool bListed = GENERATE(true, false);
    for (VDA5050::AgvAction& action : standard.factsheet.protocolFeatures.agvActions)
    {
        if (!bListed)
        {
            action.actionParameters.clear();
        }
    }
    const VDA5050::FactsheetMessage* const factsheetOrNull = GENERATE(true, false) ? &standard.factsheet : nullptr;
    RobotActionRequest request = MakePositionRequest();
    CHECK(check.FindErrorOrNull(request, factsheetOrNull) == std::nullopt);
    request.parameters.pop_back();
    CHECK(
        check.FindErrorOrNull(request, factsheetOrNull)
        == "The parameter lastNodeId of initPosition is missing. Its parameters: x (NUMBER), y (NUMBER), theta (NUMBER), mapId "
           "(STRING), lastNodeId (STRING).");
    request = MakePositionRequest();
    request.parameters.push_back({"speed", Core::JsonText::FromNumber(1)});
    CHECK(check.FindErrorOrNull(request, factsheetOrNull)->starts_with(R"(initPosition has no parameter "speed".)"));
    request = MakePositionRequest();
    request.parameters.front().value = Core::JsonText::FromString("1.5");
    CHECK(
        check.FindErrorOrNull(request, factsheetOrNull)
        == R"(The parameter x of initPosition has the type NUMBER, found "1.5".)");
    request = {"stateRequest", {{"x", Core::JsonText::FromNumber(1)}}};
    CHECK(
        check.FindErrorOrNull(request, factsheetOrNull)
        == R"(stateRequest has no parameter "x". It has no parameters.)");
    CHECK(check.FindErrorOrNull({"stateRequest", {}}, factsheetOrNull) == std::nullopt);
    request = {
        "downloadMap",
        {{"mapId", Core::JsonText::FromString("floor-1")},
         {"mapVersion", Core::JsonText::FromString("2")},
         {"mapDownloadLink", Core::JsonText::FromString("http://10.0.0.5/floor-1")}}};
    CHECK(check.FindErrorOrNull(request, factsheetOrNull) == std::nullopt); // mapHash is optional
}

TEST_CASE("A value must have the type of the factsheet")
{
    const VDA5050::FactsheetMessage factsheet = MakeFactsheet();
    const InstantActionCheck check = MakeCheck();
    struct Sample
    {
        std::string key;
        std::vector<std::string> valid;
    };
    const std::vector<std::string> values{"true", "1.5", "2", R"("text")", "{}", "[]"};
    for (const Sample& sample :
         {Sample{"b", {"true"}},
          Sample{"n", {"1.5", "2"}},
          Sample{"f", {"1.5", "2"}},
          Sample{"i", {"2"}},
          Sample{"s", {R"("text")"}},
          Sample{"o", {"{}"}},
          Sample{"a", {"[]"}}})
    {
        for (const std::string& value : values)
        {
            const bool bValid = std::ranges::count(sample.valid, value) == 1;
            const RobotActionRequest request{"beep", {{sample.key, Core::JsonText::FromTrusted(value)}}};
            INFO(sample.key << " " << value);
            CHECK(check.FindErrorOrNull(request, &factsheet).has_value() != bValid);
        }
    }
}

TEST_CASE("An action that acsd sends itself is refused, with the command to use instead")
{
    StandardFactsheet standard;
    standard.GetPick().actionScopes.push_back(VDA5050::EActionScope::Instant);
    const InstantActionCheck check = MakeCheck();
    const VDA5050::FactsheetMessage* const factsheetOrNull = GENERATE(true, false) ? &standard.factsheet : nullptr;
    for (const auto& [actionType, part] :
         {std::pair("cancelOrder", "acsctl abort PLAN"),
          std::pair("startPause", "acsctl pause PLAN"),
          std::pair("stopPause", "acsctl resume PLAN"),
          std::pair("startCharging", "robots.NAME.charge"),
          std::pair("stopCharging", "charges its robots itself"),
          std::pair("pick", "Use a plan of the MCS")})
    {
        const std::optional<std::string> error = check.FindErrorOrNull({actionType, {}}, factsheetOrNull);
        INFO(actionType);
        REQUIRE(error.has_value());
        CHECK(error->find(part) != std::string::npos);
        CHECK(ListTypes(check, factsheetOrNull).find(actionType) == std::string::npos);
    }
}

} // namespace ACS::Acsd::Test
