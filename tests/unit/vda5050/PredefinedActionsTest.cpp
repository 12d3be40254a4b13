#include "Catch.hpp"
#include "VehicleSessionFixture.hpp"
#include <acs/vda5050/PredefinedActions.hpp>

#include <algorithm>

namespace ACS::VDA5050::Test
{

namespace
{

using Names = std::vector<std::string>;

/// A row of the table of actions as the standard has it: "I" instant, "N" node, "E" edge; a "?" behind what may be left
/// out, a "#" in front of a number.
struct Row
{
    const char* actionType;
    std::string scopes;
    Names parameters;
};

const std::vector<Row>& GetRows()
{
    static const Names HANDLING{"lhd?", "stationName?", "loadId?", "#height?", "#depth?", "side?"};
    static const auto WITH = [](Names more) {
        more.insert(more.end(), HANDLING.begin(), HANDLING.end());
        return more;
    };
    static const std::vector<Row> ROWS{
        {"startPause", "I", {}},
        {"stopPause", "I", {}},
        {"startCharging", "IN", {}},
        {"stopCharging", "IN", {}},
        {"initPosition", "IN", {"#x", "#y", "#theta", "mapId", "lastNodeId"}},
        {"enableMap", "IN", {"mapId", "mapVersion"}},
        {"downloadMap", "I", {"mapId", "mapVersion", "mapDownloadLink", "mapHash?"}},
        {"deleteMap", "I", {"mapId", "mapVersion"}},
        {"stateRequest", "I", {}},
        {"logReport", "I", {"reason"}},
        {"pick", "NE", WITH({"stationType", "loadType"})},
        {"drop", "NE", WITH({"stationType?", "loadType?"})},
        {"detectObject", "NE", {"objectType?"}},
        {"finePositioning", "NE", {"stationType?", "stationName?"}},
        {"waitForTrigger", "N", {"triggerType"}},
        {"cancelOrder", "I", {}},
        {"factsheetRequest", "I", {}},
    };
    return ROWS;
}

std::string GetKey(const std::string& parameter)
{
    std::string key = parameter;
    std::erase(key, '?');
    std::erase(key, '#');
    return key;
}

std::vector<ActionParameter> MakeParameters(const Row& row, bool bAll)
{
    std::vector<ActionParameter> parameters;
    for (const std::string& parameter : row.parameters)
    {
        if (bAll || !parameter.ends_with('?'))
        {
            const bool bNumber = parameter.starts_with('#');
            parameters.push_back(
                {GetKey(parameter), bNumber ? Core::JsonText::FromNumber(0.5) : Core::JsonText::FromString("text")});
        }
    }
    return parameters;
}

/// The parameter for which a vehicle with the standard's rows rejects an order with this action; empty if accepted.
std::string FindBlame(const Action& action, EActionScope scope, EParameterCheck check = EParameterCheck::Tolerant)
{
    OrderMessage order = MakeOrder(2, 2);
    (scope == EActionScope::Node ? order.nodes[1].actions : order.edges[0].actions).push_back(action);
    FactsheetMessage factsheet;
    factsheet.protocolFeatures.agvActions = GetPredefinedActions();
    OrderContext context;
    context.lastNodeID = "N0";
    context.factsheet = &factsheet;
    context.parameterCheck = check;
    const OrderJudgement judgement = JudgeOrder(order, context);
    if (judgement.verdict != EOrderVerdict::Reject)
    {
        return {};
    }
    REQUIRE(judgement.violations.size() == 1);
    const VehicleError& error = judgement.violations[0].error;
    CHECK(error.errorType == ErrorTypes::ORDER_ERROR);
    CHECK(*FindReferenceOrNull(error, "actionId") == action.actionID);
    return *FindReferenceOrNull(error, "parameter");
}

Action MakeRowAction(const Row& row, bool bAll)
{
    Action action = MakeAction("a1", EBlockingType::Hard, row.actionType);
    action.actionParameters = MakeParameters(row, bAll);
    return action;
}

} // namespace

TEST_CASE("5.7 The table of predefined actions has the rows of the standard")
{
    CHECK(GetPredefinedActions().size() == GetRows().size());
    for (const Row& row : GetRows())
    {
        CAPTURE(row.actionType);
        const AgvAction* found = FindPredefinedActionOrNull(row.actionType);
        REQUIRE(found != nullptr);
        CHECK(found->actionScopes.size() == row.scopes.size());
        CHECK(found->actionParameters.size() == row.parameters.size());
    }
    CHECK(FindPredefinedActionOrNull("makeCoffee") == nullptr);
}

TEST_CASE("5.7 Each row: the scopes, the parameters that must be there, those that may, and their types")
{
    for (const Row& row : GetRows())
    {
        CAPTURE(row.actionType);
        const std::string onNode = row.scopes.find('N') != std::string::npos ? "" : "actionType";
        const std::string onEdge = row.scopes.find('E') != std::string::npos ? "" : "actionType";
        for (const bool bAll : {false, true})
        {
            CHECK(FindBlame(MakeRowAction(row, bAll), EActionScope::Node) == onNode);
            CHECK(FindBlame(MakeRowAction(row, bAll), EActionScope::Edge) == onEdge);
        }
        if (!onNode.empty())
        {
            continue;
        }
        for (const std::string& parameter : row.parameters)
        {
            CAPTURE(parameter);
            const std::string key = GetKey(parameter);
            Action without = MakeRowAction(row, true);
            std::erase_if(without.actionParameters, [&key](const ActionParameter& given) { return given.key == key; });
            CHECK(FindBlame(without, EActionScope::Node) == (parameter.ends_with('?') ? "" : key));
            Action wrong = MakeRowAction(row, true);
            std::ranges::find(wrong.actionParameters, key, &ActionParameter::key)->value =
                Core::JsonText::FromBoolean(true);
            CHECK(FindBlame(wrong, EActionScope::Node) == key);
        }
        if (!row.parameters.empty())
        {
            Action more = MakeRowAction(row, true);
            more.actionParameters.push_back({"invented", Core::JsonText::FromBoolean(true)});
            CHECK(FindBlame(more, EActionScope::Node) == "invented");
        }
    }
}

TEST_CASE("5.7 Each row as an instant action: taken by a vehicle that lists it, failed where it is none or lacks a "
          "parameter")
{
    for (const Row& row : GetRows())
    {
        CAPTURE(row.actionType);
        VehicleOptions options = VehicleSessionFixture::MakeOptions();
        options.factsheet.protocolFeatures.agvActions = GetPredefinedActions();
        VehicleSessionFixture bench(options);
        const bool bInstant = row.scopes.find('I') != std::string::npos;
        for (const std::string& parameter : row.parameters)
        {
            if (!parameter.ends_with('?'))
            {
                std::vector<ActionParameter> parameters = MakeParameters(row, true);
                const std::string key = GetKey(parameter);
                std::erase_if(parameters, [&key](const ActionParameter& given) { return given.key == key; });
                bench.Instant(row.actionType, "without-" + key, parameters);
                CHECK(bench.GetStatus("without-" + key) == EActionStatus::Failed);
                CHECK(bench.HasError(ErrorTypes::INSTANT_ACTION_ERROR));
            }
        }
        if (!bInstant)
        {
            bench.Instant(row.actionType, "i1", MakeParameters(row, true));
            CHECK(bench.GetStatus("i1") == EActionStatus::Failed);
            CHECK(bench.HasError(ErrorTypes::INSTANT_ACTION_ERROR));
        }
    }
}

TEST_CASE("5.7 Without a list of actions a vehicle still rejects instant actions in orders")
{
    for (const Row& row : GetRows())
    {
        CAPTURE(row.actionType);
        VehicleSessionFixture bench;
        OrderMessage order = MakeOrder(2, 2);
        order.nodes[1].actions.push_back(MakeAction("a1", EBlockingType::Hard, row.actionType));
        bench.Order(order);
        CHECK(bench.HasError(ErrorTypes::ORDER_ERROR) == (row.scopes == "I"));
    }
}

TEST_CASE("5.7 A value may be written as text, as the older documents show it")
{
    const Row row{"initPosition", "IN", {"#x", "#y", "#theta", "mapId", "lastNodeId"}};
    Action action = MakeRowAction(row, true);
    action.actionParameters[0].value = Core::JsonText::FromString("1.5");
    CHECK(FindBlame(action, EActionScope::Node).empty());
    action.actionParameters[0].value = Core::JsonText::FromString("1.5m");
    CHECK(FindBlame(action, EActionScope::Node) == "x");
}

TEST_CASE("3.7 Parameters are checked strictly or leniently, as configured")
{
    Action pick = MakeRowAction({"pick", "NE", {"stationType", "loadType"}}, true);
    Action text = pick;
    text.actionParameters.push_back({"height", Core::JsonText::FromString("0.8")});
    CHECK(FindBlame(text, EActionScope::Node, EParameterCheck::Tolerant).empty());
    CHECK(FindBlame(text, EActionScope::Node, EParameterCheck::Strict) == "height");
    CHECK(FindBlame(text, EActionScope::Node, EParameterCheck::Lenient).empty());

    Action more = pick;
    more.actionParameters.push_back({"invented", Core::JsonText::FromBoolean(true)});
    CHECK(FindBlame(more, EActionScope::Node, EParameterCheck::Tolerant) == "invented");
    CHECK(FindBlame(more, EActionScope::Node, EParameterCheck::Strict) == "invented");
    CHECK(FindBlame(more, EActionScope::Node, EParameterCheck::Lenient).empty());

    Action bare = MakeAction("a1", EBlockingType::Hard, "startCharging");
    CHECK(FindBlame(bare, EActionScope::Node, EParameterCheck::Strict).empty());
    bare.actionParameters.push_back({"invented", Core::JsonText::FromBoolean(true)});
    CHECK(FindBlame(bare, EActionScope::Node, EParameterCheck::Tolerant).empty());
    CHECK(FindBlame(bare, EActionScope::Node, EParameterCheck::Strict) == "invented");

    pick.actionParameters.pop_back();
    CHECK(FindBlame(pick, EActionScope::Node, EParameterCheck::Lenient) == "loadType");
}

TEST_CASE("3.7 A blocking type that the factsheet does not list refuses the order")
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    AgvAction pick = *FindPredefinedActionOrNull("pick");
    pick.actionParameters.clear();
    pick.blockingTypes = {EBlockingType::Soft, EBlockingType::Hard};
    pick.actionType = "lift";
    options.factsheet.protocolFeatures.agvActions = {pick};
    for (const EBlockingType blocking : {EBlockingType::None, EBlockingType::Soft, EBlockingType::Hard})
    {
        VehicleSessionFixture bench(options);
        OrderMessage order = MakeOrder(2, 2);
        order.nodes[1].actions.push_back(MakeAction("a1", blocking, "lift"));
        bench.Order(order);
        CHECK(bench.HasError(ErrorTypes::ORDER_ERROR) == (blocking == EBlockingType::None));
    }
}

} // namespace ACS::VDA5050::Test
