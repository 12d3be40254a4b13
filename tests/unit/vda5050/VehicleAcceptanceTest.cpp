#include "Catch.hpp"
#include "VehicleSessionFixture.hpp"
#include <acs/vda5050/Vda5050Codec.hpp>

#include <functional>
#include <optional>

namespace ACS::VDA5050::Test
{

namespace
{

/// One leaf of the tree: the state before, the message, and the result.
struct Leaf
{
    const char* name;
    std::function<void(VehicleSessionFixture&)> before;
    std::function<OrderMessage()> order;
    std::optional<std::string_view> errorType; ///< Absent: taken, or discarded.
    std::string heldOrderID;                   ///< Afterwards.
    std::uint32_t heldUpdateID;
};

OrderMessage With(OrderMessage order, const std::function<void(OrderMessage&)>& change)
{
    change(order);
    return order;
}

void Nothing(VehicleSessionFixture& /*bench*/)
{
}

/// Three nodes, two of them released; the vehicle is on its way to N1.
void UnderWay(VehicleSessionFixture& bench)
{
    bench.Order(MakeOrder(3, 2));
    bench.Drive(true);
}

/// The same without a horizon, and done.
void Completed(VehicleSessionFixture& bench)
{
    bench.Order(MakeOrder(2, 2));
    bench.Drive(true);
    bench.Reach(2);
    bench.Drive(false);
    bench.StandAt(10.0);
}

OrderMessage At(std::size_t nodeIndex, OrderMessage order)
{
    order.nodes[0].nodeID = "N" + std::to_string(nodeIndex);
    order.nodes[0].nodePosition->x = 10.0 * static_cast<double>(nodeIndex);
    if (!order.edges.empty())
    {
        order.edges[0].startNodeID = order.nodes[0].nodeID;
    }
    return order;
}

void CheckLeaf(const Leaf& leaf)
{
    CAPTURE(leaf.name);
    VehicleSessionFixture bench;
    leaf.before(bench);
    const StateMessage before = bench.GetSession().GetState();
    bench.Clear();
    bench.Order(leaf.order());
    const StateMessage after = bench.GetSession().GetState();
    CHECK(after.orderID == leaf.heldOrderID);
    CHECK(after.orderUpdateID == leaf.heldUpdateID);
    CHECK(bench.GetPublishedStates().size() == 1); // 4.6: an order received, refused or not, is a reason
    if (!leaf.errorType.has_value())
    {
        CHECK(after.errors.empty());
        CHECK(Pick<OrderRefused>(bench.GetOutput()).empty());
        return;
    }
    REQUIRE(after.errors.size() == 1);
    const VehicleError& error = after.errors[0];
    CHECK(error.errorType == *leaf.errorType);
    CHECK(error.errorLevel == EErrorLevel::Warning);
    for (const char* key : {"topic", "headerId", "orderId", "orderUpdateId"})
    {
        CAPTURE(key);
        CHECK(FindReferenceOrNull(error, key) != nullptr);
    }
    // Nothing of the message was applied, and the running order continues.
    CHECK(after.nodeStates == before.nodeStates);
    CHECK(after.edgeStates == before.edgeStates);
    CHECK(after.actionStates == before.actionStates);
    CHECK(after.lastNodeID == before.lastNodeID);
    CHECK(Pick<DriveTo>(bench.GetOutput()).empty());
    CHECK(Pick<OrderTaken>(bench.GetOutput()).empty());
}

} // namespace

TEST_CASE("4.2 Each leaf of the acceptance tree for a new order")
{
    const std::vector<Leaf> leaves{
        {"structure broken",
         UnderWay,
         [] { return With(MakeOrder(2, 2, "o2"), [](OrderMessage& order) { order.edges.clear(); }); },
         ErrorTypes::VALIDATION_ERROR,
         "order-1",
         0},
        {"accepted where there was none", Nothing, [] { return MakeOrder(3, 2); }, std::nullopt, "order-1", 0},
        {"accepted with an orderUpdateId other than 0",
         Nothing,
         [] { return With(MakeOrder(3, 2), [](OrderMessage& order) { order.orderUpdateID = 7; }); },
         std::nullopt,
         "order-1",
         7},
        {"accepted after a completed one",
         Completed,
         [] { return At(1, MakeOrder(1, 1, "o2")); },
         std::nullopt,
         "o2",
         0},
        {"accepted after a cancelled one",
         [](VehicleSessionFixture& bench) {
             UnderWay(bench);
             bench.Instant("cancelOrder", "c1");
             bench.Drive(false);
         },
         [] { return MakeOrder(2, 2, "o2"); },
         std::nullopt,
         "o2",
         0},
        {"nodes left to reach",
         UnderWay,
         [] { return MakeOrder(2, 2, "o2"); },
         ErrorTypes::ORDER_UPDATE_ERROR,
         "order-1",
         0},
        {"only a horizon left",
         [](VehicleSessionFixture& bench) {
             UnderWay(bench);
             bench.Reach(2);
             bench.StandAt(10.0);
         },
         [] { return At(1, MakeOrder(1, 1, "o2")); },
         ErrorTypes::ORDER_UPDATE_ERROR,
         "order-1",
         0},
        {"only an action left",
         [](VehicleSessionFixture& bench) {
             OrderMessage order = MakeOrder(1, 1);
             order.nodes[0].actions.push_back(MakeAction("a1", EBlockingType::None));
             bench.Order(order);
         },
         [] { return MakeOrder(2, 2, "o2"); },
         ErrorTypes::ORDER_UPDATE_ERROR,
         "order-1",
         0},
        {"a cancel runs",
         [](VehicleSessionFixture& bench) {
             UnderWay(bench);
             bench.Instant("cancelOrder", "c1");
         },
         [] { return MakeOrder(2, 2, "o2"); },
         ErrorTypes::ORDER_UPDATE_ERROR,
         "order-1",
         0},
        {"not on the first node",
         [](VehicleSessionFixture& bench) { bench.StandAt(3.0); },
         [] { return MakeOrder(2, 2); },
         ErrorTypes::NO_ROUTE_ERROR,
         "",
         0},
        {"inside the range of the first node",
         [](VehicleSessionFixture& bench) { bench.StandAt(3.0); },
         [] {
             return With(MakeOrder(2, 2), [](OrderMessage& order) {
                 order.nodes[0].nodePosition->allowedDeviationXY = 3.5;
             });
         },
         std::nullopt,
         "order-1",
         0},
        {"inside the range, turned the other way",
         [](VehicleSessionFixture& bench) { bench.StandAt(3.0); },
         [] {
             return With(At(9, MakeOrder(2, 2)), [](OrderMessage& order) {
                 order.nodes[0].nodePosition->x = 3.0;
                 order.nodes[0].nodePosition->theta = 3.0;
                 order.nodes[0].nodePosition->allowedDeviationTheta = 0.5;
             });
         },
         ErrorTypes::NO_ROUTE_ERROR,
         "",
         0},
        {"inside the range, turned almost as asked, across the end of the circle",
         [](VehicleSessionFixture& bench) { bench.StandAt(3.0, 3.1); },
         [] {
             return With(At(9, MakeOrder(2, 2)), [](OrderMessage& order) {
                 order.nodes[0].nodePosition->x = 3.0;
                 order.nodes[0].nodePosition->theta = -3.1;
                 order.nodes[0].nodePosition->allowedDeviationTheta = 0.5;
             });
         },
         std::nullopt,
         "order-1",
         0},
        {"on another map",
         Nothing,
         [] { return With(MakeOrder(2, 2), [](OrderMessage& order) { order.nodes[0].nodePosition->mapID = "roof"; }); },
         ErrorTypes::NO_ROUTE_ERROR,
         "",
         0},
        {"no position, the first node is lastNodeId",
         Nothing,
         [] { return With(MakeOrder(2, 2), [](OrderMessage& order) { order.nodes[0].nodePosition.reset(); }); },
         std::nullopt,
         "order-1",
         0},
        {"no position, another node",
         Nothing,
         [] { return With(At(1, MakeOrder(2, 2)), [](OrderMessage& order) { order.nodes[0].nodePosition.reset(); }); },
         ErrorTypes::NO_ROUTE_ERROR,
         "",
         0},
        {"does not begin with sequenceId 0",
         Nothing,
         [] { return With(MakeOrder(1, 1), [](OrderMessage& order) { order.nodes[0].sequenceID = 2; }); },
         ErrorTypes::VALIDATION_ERROR,
         "",
         0},
    };
    for (const Leaf& leaf : leaves)
    {
        CheckLeaf(leaf);
    }
}

TEST_CASE("4.2 Each leaf of the acceptance tree for an update")
{
    const auto cancelled = [](VehicleSessionFixture& bench) {
        UnderWay(bench);
        bench.Instant("cancelOrder", "c1");
        bench.Drive(false);
    };
    const std::vector<Leaf> leaves{
        {"structure broken",
         UnderWay,
         [] { return With(MakeUpdate(3, 2, 3), [](OrderMessage& order) { order.edges[0].endNodeID = "N9"; }); },
         ErrorTypes::VALIDATION_ERROR,
         "order-1",
         0},
        {"a lower orderUpdateId",
         [](VehicleSessionFixture& bench) {
             bench.Order(With(MakeOrder(3, 2), [](OrderMessage& order) { order.orderUpdateID = 5; }));
         },
         [] { return With(MakeUpdate(3, 2, 3), [](OrderMessage& order) { order.orderUpdateID = 4; }); },
         ErrorTypes::ORDER_UPDATE_ERROR,
         "order-1",
         5},
        {"an equal orderUpdateId", UnderWay, [] { return MakeOrder(3, 2); }, std::nullopt, "order-1", 0},
        {"an equal orderUpdateId with other contents",
         UnderWay,
         [] { return MakeOrder(2, 1); },
         std::nullopt,
         "order-1",
         0},
        {"executing, at the decision point", UnderWay, [] { return MakeUpdate(4, 2, 3); }, std::nullopt, "order-1", 1},
        {"executing, an orderUpdateId that leaves a gap",
         UnderWay,
         [] { return With(MakeUpdate(4, 2, 3), [](OrderMessage& order) { order.orderUpdateID = 40; }); },
         std::nullopt,
         "order-1",
         40},
        {"executing, another node",
         UnderWay,
         [] { return MakeUpdate(5, 3, 4); },
         ErrorTypes::ORDER_UPDATE_ERROR,
         "order-1",
         0},
        {"executing, the base sent again",
         UnderWay,
         [] { return With(MakeOrder(3, 3), [](OrderMessage& order) { order.orderUpdateID = 1; }); },
         ErrorTypes::ORDER_UPDATE_ERROR,
         "order-1",
         0},
        {"executing, the right node with a wrong sequenceId",
         UnderWay,
         [] { return With(At(1, MakeOrder(2, 2)), [](OrderMessage& order) { order.orderUpdateID = 1; }); },
         ErrorTypes::ORDER_UPDATE_ERROR,
         "order-1",
         0},
        {"executing, the right sequenceId with a wrong node",
         UnderWay,
         [] {
             return With(MakeUpdate(3, 2, 3), [](OrderMessage& order) {
                 order.nodes[0].nodeID = "N7";
                 order.edges[0].startNodeID = "N7";
             });
         },
         ErrorTypes::ORDER_UPDATE_ERROR,
         "order-1",
         0},
        {"completed, at the last node", Completed, [] { return MakeUpdate(3, 2, 3); }, std::nullopt, "order-1", 1},
        {"completed, another node",
         Completed,
         [] { return MakeUpdate(5, 3, 4); },
         ErrorTypes::ORDER_UPDATE_ERROR,
         "order-1",
         0},
        {"during a cancel",
         [](VehicleSessionFixture& bench) {
             UnderWay(bench);
             bench.Instant("cancelOrder", "c1");
         },
         [] { return MakeUpdate(3, 2, 3); },
         ErrorTypes::ORDER_UPDATE_ERROR,
         "order-1",
         0},
        {"after a cancel, at the decision point that was",
         cancelled,
         [] { return MakeUpdate(3, 2, 3); },
         ErrorTypes::ORDER_UPDATE_ERROR,
         "order-1",
         0},
        {"after a cancel, at lastNodeId, which the vehicle has left",
         [&cancelled](VehicleSessionFixture& bench) {
             cancelled(bench);
             bench.StandAt(5.0);
         },
         [] { return MakeUpdate(3, 1, 3); },
         ErrorTypes::NO_ROUTE_ERROR,
         "order-1",
         0},
        {"after a cancel, at lastNodeId, where the vehicle is stationary",
         cancelled,
         [] { return MakeUpdate(3, 1, 3); },
         std::nullopt,
         "order-1",
         1},
    };
    for (const Leaf& leaf : leaves)
    {
        CheckLeaf(leaf);
    }
}

TEST_CASE("4.2 An order that requires something that the vehicle does not have is rejected with orderError")
{
    struct Case
    {
        const char* field;
        std::function<void(OrderMessage&)> use;
    };
    const std::vector<Case> cases{
        {"order.zoneSetId",
         [](OrderMessage& order) {
             order.zoneSetID = "z";
         }},
        {"order.nodes.nodePosition.theta",
         [](OrderMessage& order) {
             order.nodes[0].nodePosition->theta = 0.0;
         }},
        {"order.nodes.nodePosition.allowedDeviationXY",
         [](OrderMessage& order) {
             order.nodes[0].nodePosition->allowedDeviationXY = 0.5;
         }},
        {"order.nodes.nodePosition.allowedDeviationTheta",
         [](OrderMessage& order) {
             order.nodes[0].nodePosition->allowedDeviationTheta = 0.5;
         }},
        {"order.edges.maxSpeed",
         [](OrderMessage& order) {
             order.edges[0].maxSpeed = 1.0;
         }},
        {"order.edges.maxHeight",
         [](OrderMessage& order) {
             order.edges[0].maxHeight = 1.0;
         }},
        {"order.edges.minHeight",
         [](OrderMessage& order) {
             order.edges[0].minHeight = 1.0;
         }},
        {"order.edges.orientation",
         [](OrderMessage& order) {
             order.edges[0].orientation = 1.0;
         }},
        {"order.edges.orientationType",
         [](OrderMessage& order) {
             order.edges[0].orientationType = EOrientationType::Global;
         }},
        {"order.edges.direction",
         [](OrderMessage& order) {
             order.edges[0].direction = "left";
         }},
        {"order.edges.rotationAllowed",
         [](OrderMessage& order) {
             order.edges[0].bRotationAllowed = true;
         }},
        {"order.edges.maxRotationSpeed",
         [](OrderMessage& order) {
             order.edges[0].maxRotationSpeed = 1.0;
         }},
        {"order.edges.length",
         [](OrderMessage& order) {
             order.edges[0].length = 10.0;
         }},
        {"order.edges.trajectory",
         [](OrderMessage& order) {
             order.edges[0].trajectory =
                 Trajectory{1, {0.0, 0.0, 1.0, 1.0}, {ControlPoint{}, ControlPoint{10.0, 0.0, {}}}};
         }},
        {"order.edges.corridor",
         [](OrderMessage& order) {
             order.edges[0].corridor = Corridor{1.0, 1.0, {}};
         }},
    };
    for (const Case& member : cases)
    {
        CAPTURE(member.field);
        OrderMessage order = MakeOrder(2, 2);
        OrderContext context;
        context.lastNodeID = "N0";
        FactsheetMessage factsheet;
        context.factsheet = &factsheet;
        member.use(order);
        CHECK(JudgeOrder(order, context).verdict == EOrderVerdict::NewOrder); // no list
        factsheet.protocolFeatures.optionalParameters.emplace();
        const OrderJudgement none = JudgeOrder(order, context);
        CHECK(std::ranges::any_of(none.violations, [&member](const OrderViolation& violation) {
            return *FindReferenceOrNull(violation.error, "parameter") == member.field;
        }));
        // nodePosition itself is in use in every order here.
        factsheet.protocolFeatures.optionalParameters = {
            OptionalParameter{"order.nodes.nodePosition", EParameterSupport::Supported, {}}};
        const OrderJudgement refused = JudgeOrder(order, context);
        REQUIRE(refused.violations.size() == 1);
        CHECK(refused.violations[0].error.errorType == ErrorTypes::ORDER_ERROR);
        CHECK(*FindReferenceOrNull(refused.violations[0].error, "parameter") == member.field);
        factsheet.protocolFeatures.optionalParameters->push_back(
            OptionalParameter{member.field, EParameterSupport::Supported, {}});
        CHECK(JudgeOrder(order, context).verdict == EOrderVerdict::NewOrder);
        factsheet.protocolFeatures.optionalParameters->back().support = EParameterSupport::Required;
        const OrderJudgement missing = JudgeOrder(MakeOrder(2, 2), context);
        REQUIRE(missing.violations.size() == 1);
        CHECK(*FindReferenceOrNull(missing.violations[0].error, "parameter") == member.field);
    }
}

TEST_CASE("4.1 An actionId that the state still shows is not accepted again")
{
    const auto withAction = [](OrderMessage order, std::size_t node, const char* actionID) {
        order.nodes[node].actions.push_back(MakeAction(actionID, EBlockingType::None));
        return order;
    };
    VehicleSessionFixture bench;
    bench.Order(withAction(withAction(MakeOrder(3, 2), 1, "base"), 2, "horizon"));
    bench.Order(withAction(MakeUpdate(3, 2, 3), 1, "base"));
    CHECK(bench.HasError(ErrorTypes::VALIDATION_ERROR));
    CHECK(bench.GetSession().GetState().orderUpdateID == 0);
    // The stitching node has its actions already, and what the horizon had may come again.
    bench.Order(withAction(withAction(MakeUpdate(3, 2, 3), 0, "base"), 1, "horizon"));
    CHECK(bench.GetSession().GetState().orderUpdateID == 1);
    CHECK(bench.GetSession().GetState().actionStates.size() == 2);
    CHECK(bench.GetSession().GetState().errors.empty());
}

TEST_CASE("4.2 The application's own check rejects an order with the errors that it returns")
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.orderCheck = [](const OrderMessage& order, const OrderContext& /*context*/) {
        std::vector<OrderViolation> violations;
        if (order.nodes.size() > 2)
        {
            violations.push_back(MakeOrderViolation(order, ErrorTypes::NO_ROUTE_ERROR, "too far for the battery"));
        }
        return violations;
    };
    VehicleSessionFixture bench(options);
    bench.Order(MakeOrder(3, 3));
    CHECK(bench.HasError(ErrorTypes::NO_ROUTE_ERROR));
    CHECK(bench.GetSession().GetState().orderID.empty());
    bench.Order(MakeOrder(2, 2));
    CHECK(bench.GetSession().GetState().orderID == "order-1");
    CHECK(bench.GetSession().GetState().errors.empty());
}

} // namespace ACS::VDA5050::Test
