#include "MasterSessionFixture.hpp"
#include <acs/vda5050/EVda5050Error.hpp>
#include <acs/vda5050/OrderBuilder.hpp>

#include <functional>
#include <initializer_list>

namespace ACS::VDA5050::Test
{

namespace
{

struct FitFixture : MasterSessionFixture
{
    FitFixture()
    {
        BeReady();
    }

    void Deliver(const FactsheetMessage& factsheet)
    {
        MasterSessionFixture::Deliver(ETopic::Factsheet, Vda5050Codec().Encode(factsheet, EVda5050Version::Version210));
    }

    [[nodiscard]] Core::Result<void> Send(const OrderMessage& order)
    {
        return session.SendOrder(order, GetNow(), Clear());
    }

    /// The path of the error; empty: the order can be sent.
    [[nodiscard]] std::string Check(const OrderMessage& order) const
    {
        const Core::Result<void> checked = session.CheckOrder(order, GetNow());
        return checked ? std::string() : checked.error().path;
    }
};

FactsheetMessage MakeBareFactsheet()
{
    FactsheetMessage factsheet;
    factsheet.header = Header{0, {}, "2.0.0", "ACS", "LR01"};
    return factsheet;
}

FactsheetMessage MakeListing(
    std::initializer_list<const char*> members,
    EParameterSupport support = EParameterSupport::Supported)
{
    FactsheetMessage factsheet = MakeBareFactsheet();
    std::vector<OptionalParameter>& list = factsheet.protocolFeatures.optionalParameters.emplace();
    for (const char* member : members)
    {
        list.push_back({member, support, {}});
    }
    return factsheet;
}

} // namespace

TEST_CASE("3.7 Optional members that a vehicle can do without are left out where it does not support them")
{
    FitFixture bench;
    OrderMessage order = MakeOrder(2, 2);
    order.nodes[1].nodePosition->theta = 1.0;
    order.nodes[1].nodePosition->allowedDeviationTheta = 0.1;
    order.edges[0].orientationType = EOrientationType::Global;
    order.edges[0].bRotationAllowed = true;
    order.edges[0].length = 10.0;
    SECTION("none is supported")
    {
        bench.Deliver(MakeListing({}));
        REQUIRE(bench.Send(order).has_value());
        CHECK_FALSE(bench.GetSentOrder().nodes[0].nodePosition.has_value());
        CHECK_FALSE(bench.GetSentOrder().nodes[1].nodePosition.has_value());
    }
    SECTION("only positions are")
    {
        bench.Deliver(MakeListing({"order.nodes.nodePosition"}));
        REQUIRE(bench.Send(order).has_value());
        const NodePosition position = *bench.GetSentOrder().nodes[1].nodePosition;
        CHECK(position.x == order.nodes[1].nodePosition->x);
        CHECK_FALSE(position.theta.has_value());
        CHECK_FALSE(position.allowedDeviationTheta.has_value());
    }
    const OrderEdge edge = bench.GetSentOrder().edges[0];
    CHECK_FALSE(edge.orientationType.has_value());
    CHECK_FALSE(edge.bRotationAllowed.has_value());
    CHECK_FALSE(edge.length.has_value());
}

TEST_CASE(
    "3.7 Optional members that demand something are never left out: the order is not sent, and the error has its name")
{
    struct Case
    {
        const char* path;
        std::function<void(OrderEdge&)> demand;
    };
    const std::vector<Case> cases{
        {"order.edges.maxSpeed",
         [](OrderEdge& edge) {
             edge.maxSpeed = 0.3;
         }},
        {"order.edges.maxHeight",
         [](OrderEdge& edge) {
             edge.maxHeight = 2.0;
         }},
        {"order.edges.minHeight",
         [](OrderEdge& edge) {
             edge.minHeight = 1.0;
         }},
        {"order.edges.orientation",
         [](OrderEdge& edge) {
             edge.orientation = 1.5;
         }},
        {"order.edges.direction",
         [](OrderEdge& edge) {
             edge.direction = "left";
         }},
        {"order.edges.rotationAllowed",
         [](OrderEdge& edge) {
             edge.bRotationAllowed = false;
         }},
        {"order.edges.maxRotationSpeed",
         [](OrderEdge& edge) {
             edge.maxRotationSpeed = 0.2;
         }},
        {"order.edges.trajectory", [](OrderEdge& edge) {
             edge.trajectory = Trajectory{1, {0.0, 0.0, 1.0, 1.0}, {ControlPoint{}, ControlPoint{10.0, 0.0, {}}}};
         }}};
    for (const Case& member : cases)
    {
        CAPTURE(member.path);
        FitFixture bench;
        OrderMessage order = MakeOrder(2, 2);
        member.demand(order.edges[0]);
        bench.Deliver(MakeListing({}));
        CHECK(bench.Check(order) == member.path);
        CHECK_FALSE(bench.Send(order).has_value());
        bench.Deliver(MakeListing({member.path}));
        CHECK(bench.Check(order).empty());
    }
    FitFixture bench;
    OrderMessage order = MakeOrder(2, 2);
    order.edges[0].orientation = 1.5;
    order.edges[0].orientationType = EOrientationType::Global;
    bench.Deliver(MakeListing({"order.edges.orientation"}));
    CHECK(bench.Check(order) == "order.edges.orientationType");
    order.edges[0].orientationType = EOrientationType::Tangential; // the default
    CHECK(bench.Check(order).empty());
}

TEST_CASE("3.7 A required member without a value is filled in where a value restricts nothing")
{
    FitFixture bench;
    FactsheetMessage factsheet = MakeListing(
        {"order.nodes.nodePosition.allowedDeviationTheta",
         "order.edges.maxSpeed",
         "order.edges.orientationType",
         "order.edges.rotationAllowed"},
        EParameterSupport::Required);
    bench.Deliver(factsheet);
    CHECK(bench.Check(MakeOrder(2, 2)) == "order.edges.maxSpeed"); // the factsheet states no speed
    factsheet.physicalParameters.speedMax = 1.25;
    bench.Deliver(factsheet);
    REQUIRE(bench.Send(MakeOrder(2, 2)).has_value());
    const OrderMessage sent = bench.GetSentOrder();
    CHECK(sent.nodes[1].nodePosition->allowedDeviationTheta == Approx(3.14159).margin(0.001));
    CHECK(sent.edges[0].maxSpeed == 1.25);
    CHECK(sent.edges[0].orientationType == EOrientationType::Tangential);
    CHECK(sent.edges[0].bRotationAllowed == true);
}

TEST_CASE("3.7 A text is sent as the number or boolean that the factsheet lists, if it is one")
{
    struct Case
    {
        EValueDataType type;
        std::string text;
        std::string sent; ///< Empty: an error that names the parameter.
    };
    for (const Case& value : std::vector<Case>{
             {EValueDataType::Number, "1.25", "1.25"},
             {EValueDataType::Number, "-3", "-3"},
             {EValueDataType::Float, "1e3", "1000"},
             {EValueDataType::Number, "1,25", ""},
             {EValueDataType::Number, "nan", ""},
             {EValueDataType::Number, "", ""},
             {EValueDataType::Integer, "9007199254740993", "9007199254740993"},
             {EValueDataType::Integer, "4.0", "4"},
             {EValueDataType::Integer, "4.5", ""},
             {EValueDataType::Bool, "false", "false"},
             {EValueDataType::Bool, "False", ""},
             {EValueDataType::String, "1.25", R"("1.25")"},
         })
    {
        CAPTURE(value.type, value.text);
        FactsheetMessage factsheet = MakeBareFactsheet();
        AgvAction& row = factsheet.protocolFeatures.agvActions.emplace_back();
        row.actionType = "lift";
        row.actionScopes = {EActionScope::Node};
        row.actionParameters = {{"height", value.type, {}, false}};
        FitFixture bench;
        bench.Deliver(factsheet);
        OrderMessage order = MakeOrder(2, 2);
        Action action = MakeAction("lift-1", EBlockingType::Hard, "lift");
        action.actionParameters = {{"height", Core::JsonText::FromString(value.text)}};
        order.nodes[1].actions.push_back(action);
        CHECK(bench.Check(order) == (value.sent.empty() ? "height" : ""));
        if (!value.sent.empty())
        {
            REQUIRE(bench.Send(order));
            CHECK(bench.GetSentOrder().nodes[1].actions[0].actionParameters[0].value.GetText() == value.sent);
        }
    }
}

TEST_CASE("3.7 The horizon is shortened to what the vehicle accepts, the base is not")
{
    FitFixture bench;
    FactsheetMessage factsheet = MakeBareFactsheet();
    ProtocolLimits& limits = factsheet.protocolLimits;
    const OrderMessage order = MakeOrder(8, 3);
    std::size_t most = 0;
    SECTION("nodes")
    {
        most = GENERATE(as<std::size_t>(), 3, 4, 7, 8, 9);
        limits.maxArrayLengths.orderNodes = static_cast<std::uint32_t>(most);
    }
    SECTION("edges")
    {
        most = 5;
        limits.maxArrayLengths.orderEdges = 4;
    }
    SECTION("node states")
    {
        most = 6;
        limits.maxArrayLengths.stateNodeStates = 5;
    }
    SECTION("0 is no limit")
    {
        most = 8;
        limits.maxArrayLengths.orderNodes = 0;
    }
    bench.Deliver(factsheet);
    REQUIRE(bench.Send(order).has_value());
    const OrderMessage sent = bench.GetSentOrder();
    CHECK(sent.nodes.size() == std::min<std::size_t>(most, 8));
    CHECK(sent.edges.size() + 1 == sent.nodes.size());
}

TEST_CASE("3.7 The horizon is shortened to the bytes that the vehicle accepts")
{
    FitFixture bench;
    FactsheetMessage factsheet = MakeBareFactsheet();
    factsheet.protocolLimits.maxStringLengths.message = 1600;
    bench.Deliver(factsheet);
    REQUIRE(bench.Send(MakeOrder(30, 2)).has_value());
    const std::string payload = bench.GetSent(ETopic::Order).at(0).payload;
    CHECK(payload.size() <= 1600);
    CHECK(payload.size() > 1200); // one more node and edge do not fit
}

TEST_CASE("3.7 The horizon is shortened to what the state of the vehicle has room for")
{
    constexpr std::size_t NODES = 40;
    constexpr std::size_t FITTING = 35; // 2 MiB for the state, where the first node is not listed
    const std::string text(60'000, 'x');
    const auto makeLong = [&text](std::size_t released) {
        OrderMessage order = MakeOrder(NODES, released);
        for (OrderNode& node : order.nodes)
        {
            node.nodeDescription = text;
        }
        return order;
    };
    FitFixture bench;
    bench.Deliver(MakeBareFactsheet());
    CHECK(bench.Check(makeLong(FITTING + 1)) == "maximum length of the state");
    REQUIRE(bench.Send(makeLong(3)).has_value());
    CHECK(bench.GetSentOrder().nodes.size() == FITTING);
}

TEST_CASE("3.7 A base that does not fit is an error that names the limit")
{
    FitFixture bench;
    FactsheetMessage factsheet = MakeBareFactsheet();
    factsheet.protocolLimits.maxArrayLengths.orderNodes = 2;
    bench.Deliver(factsheet);
    CHECK(bench.Check(MakeOrder(8, 3)) == "maxArrayLens.order.nodes");
}

TEST_CASE("3.7 An update is checked together with the nodes that the vehicle has left")
{
    FitFixture bench;
    FactsheetMessage factsheet = MakeBareFactsheet();
    factsheet.protocolLimits.maxArrayLengths.stateNodeStates = 2;
    bench.Deliver(factsheet);
    OrderBuilder builder = MakeBuilder(5);
    const OrderMessage order = *builder.MakeOrder(3, 0);
    REQUIRE(bench.Send(order).has_value());
    bench.Hold(order, 2);
    bench.SendState();
    const OrderMessage update = *builder.MakeUpdate(4, 0);
    CHECK(bench.Check(update) == "maxArrayLens.state.nodeStates");
    bench.Hold(order, 1);
    bench.SendState();
    CHECK(bench.Check(update).empty());
}

TEST_CASE("3.7 Actions of the horizon, which an update replaces, are counted once")
{
    constexpr std::size_t SHOWN = 20;
    FitFixture bench;
    FactsheetMessage factsheet = MakeBareFactsheet();
    std::string text;
    std::string limit;
    SECTION("by number")
    {
        factsheet.protocolLimits.maxArrayLengths.stateActionStates = SHOWN + 1;
        limit = "maxArrayLens.state.actionStates";
    }
    SECTION("by bytes")
    {
        text.assign(60'000, 'x'); // 2 MiB for the state: 34 actions fit
        limit = "maximum length of the state";
    }
    bench.Deliver(factsheet);
    OrderBuilder builder = MakeBuilder(4);
    const OrderMessage order = *builder.MakeOrder(2);
    REQUIRE(bench.Send(order).has_value());
    OrderMessage update = *builder.MakeUpdate(3);
    bench.Hold(order, 2);
    for (std::size_t i = 0; i < SHOWN; ++i)
    {
        Action action = MakeAction("horizon" + std::to_string(i), EBlockingType::Hard);
        action.actionDescription = text;
        bench.state.actionStates.push_back(
            ActionState{action.actionID, action.actionType, text, EActionStatus::Waiting, {}});
        (i == 0 ? update.edges[0].actions : update.nodes[1].actions).push_back(std::move(action));
    }
    bench.SendState();
    CHECK(bench.Check(update).empty());
    for (ActionState& shown : bench.state.actionStates)
    {
        shown.actionID += " of the base";
    }
    bench.SendState();
    CHECK(bench.Check(update) == limit);
}

TEST_CASE("3.7 An update whose nodes do not match its edges is refused before it is compared with the factsheet")
{
    FitFixture bench;
    FactsheetMessage factsheet = MakeBareFactsheet();
    factsheet.protocolLimits.maxArrayLengths.stateActionStates = 1;
    bench.Deliver(factsheet);
    OrderBuilder builder = MakeBuilder(4);
    const OrderMessage order = *builder.MakeOrder(2);
    REQUIRE(bench.Send(order).has_value());
    OrderMessage update = *builder.MakeUpdate(3);
    bench.Hold(order, 2);
    bench.SendState();
    while (!update.nodes.empty())
    {
        update.nodes.pop_back();
        const auto check = bench.session.CheckOrder(update, bench.GetNow());
        REQUIRE_FALSE(check.has_value());
        CHECK(check.error().code == EVda5050Error::InvalidOrder);
    }
}

TEST_CASE("3.7 An update is checked together with the bytes of what the vehicle has left")
{
    constexpr std::size_t BASE = 20;
    const std::string text(60'000, 'x'); // 35 nodes fit
    FitFixture bench;
    bench.Deliver(MakeBareFactsheet());
    OrderBuilder builder = MakeBuilder(2 * BASE);
    const OrderMessage order = *builder.MakeOrder(BASE, 0);
    REQUIRE(bench.Send(order).has_value());
    const auto showLeft = [&bench, &order, &text](std::size_t nodesLeft) {
        bench.Hold(order, nodesLeft);
        for (NodeState& node : bench.state.nodeStates)
        {
            node.nodeDescription = text;
        }
        bench.SendState();
    };
    showLeft(BASE - 1);
    OrderMessage update = *builder.MakeUpdate(2 * BASE, 0);
    for (OrderNode& node : update.nodes)
    {
        node.nodeDescription = text;
    }
    CHECK(bench.Check(update) == "maximum length of the state");
    showLeft(BASE / 2);
    CHECK(bench.Check(update).empty());
}

TEST_CASE("3.7 An order whose horizon was left out continues after its base")
{
    FitFixture bench;
    FactsheetMessage factsheet = MakeBareFactsheet();
    factsheet.protocolLimits.maxArrayLengths.orderNodes = 2;
    bench.Deliver(factsheet);
    OrderBuilder builder = MakeBuilder(4);
    REQUIRE(bench.Send(*builder.MakeOrder(2)).has_value());
    OrderMessage sent = bench.GetSentOrder();
    for (std::size_t released = 3; released <= 4; ++released)
    {
        CHECK(sent.nodes.size() == 2);
        bench.Hold(sent, 0); // waits at the end of its base
        bench.SendState();
        CHECK(Pick<OrderFinished>(bench.GetOutput()).empty());
        CHECK(bench.session.GetOrderPhase() == EOrderPhase::Active);
        const OrderMessage update = *builder.MakeUpdate(released);
        REQUIRE(bench.session.SendOrderUpdate(update, bench.GetNow(), bench.Clear()).has_value());
        sent = bench.GetSentOrder();
    }
    bench.Hold(sent, 0);
    bench.SendState();
    CHECK(Pick<OrderFinished>(bench.GetOutput()).size() == 1);
}

TEST_CASE("3.7 The factsheet of the options is in effect until the vehicle sends its own")
{
    MasterOptions options = MakeMasterOptions();
    options.factsheet = MakeListing({});
    MasterSessionFixture bench(options);
    bench.BeReady();
    OrderMessage order = MakeOrder(2, 2);
    order.edges[0].maxSpeed = 0.3;
    REQUIRE(bench.session.GetFactsheetOrNull() != nullptr);
    CHECK_FALSE(bench.session.CheckOrder(order, bench.GetNow()).has_value());
    bench.Deliver(ETopic::Factsheet, Vda5050Codec().Encode(MakeBareFactsheet(), EVda5050Version::Version210));
    CHECK(bench.session.CheckOrder(order, bench.GetNow()).has_value());
}

} // namespace ACS::VDA5050::Test
