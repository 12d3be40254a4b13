#include "Catch.hpp"
#include "VehicleSessionFixture.hpp"

#include <cstdint>
#include <functional>
#include <vector>

namespace ACS::VDA5050::Test
{

TEST_CASE("3.7 An order that exceeds the limits of the factsheet is rejected with orderError")
{
    struct Case
    {
        const char* limit;
        std::function<void(ProtocolLimits&, std::uint32_t)> set;
        std::uint32_t found; ///< In the order below.
    };
    const std::vector<Case> cases{
        {"maxArrayLens.order.nodes",
         [](ProtocolLimits& limits, std::uint32_t value) { limits.maxArrayLengths.orderNodes = value; },
         3},
        {"maxArrayLens.order.edges",
         [](ProtocolLimits& limits, std::uint32_t value) { limits.maxArrayLengths.orderEdges = value; },
         2},
        {"maxArrayLens.node.actions",
         [](ProtocolLimits& limits, std::uint32_t value) { limits.maxArrayLengths.nodeActions = value; },
         2},
        {"maxArrayLens.edge.actions",
         [](ProtocolLimits& limits, std::uint32_t value) { limits.maxArrayLengths.edgeActions = value; },
         2},
        {"maxArrayLens.actions.actionsParameters",
         [](ProtocolLimits& limits, std::uint32_t value) { limits.maxArrayLengths.actionParameters = value; },
         2},
        {"maxArrayLens.trajectory.knotVector",
         [](ProtocolLimits& limits, std::uint32_t value) { limits.maxArrayLengths.trajectoryKnotVector = value; },
         4},
        {"maxArrayLens.trajectory.controlPoints",
         [](ProtocolLimits& limits, std::uint32_t value) { limits.maxArrayLengths.trajectoryControlPoints = value; },
         2},
        {"maxStringLens.idLen",
         [](ProtocolLimits& limits, std::uint32_t value) { limits.maxStringLengths.identifier = value; },
         7},
        {"maxStringLens.msgLen",
         [](ProtocolLimits& limits, std::uint32_t value) { limits.maxStringLengths.message = value; },
         900},
    };
    OrderMessage order = MakeOrder(3, 3);
    order.nodes[1].actions = {MakeAction("a1", EBlockingType::None), MakeAction("a2", EBlockingType::None)};
    order.edges[1].actions = {MakeAction("a3", EBlockingType::None), MakeAction("a4", EBlockingType::None)};
    order.edges[1].actions[0].actionParameters = {
        {"k1", Core::JsonText::FromInteger(1)},
        {"k2", Core::JsonText::FromInteger(2)}};
    order.edges[0].trajectory = Trajectory{1, {0.0, 0.0, 1.0, 1.0}, {ControlPoint{}, ControlPoint{10.0, 0.0, {}}}};
    for (const Case& size : cases)
    {
        CAPTURE(size.limit);
        OrderContext context;
        context.lastNodeID = "N0";
        context.payloadBytes = 900;
        FactsheetMessage factsheet;
        context.factsheet = &factsheet;
        for (const std::uint32_t allowed : {0U, size.found, size.found + 1})
        {
            size.set(factsheet.protocolLimits, allowed);
            CHECK(JudgeOrder(order, context).verdict == EOrderVerdict::NewOrder);
        }
        size.set(factsheet.protocolLimits, size.found - 1);
        const OrderJudgement refused = JudgeOrder(order, context);
        REQUIRE(refused.violations.size() == 1);
        CHECK(refused.violations[0].error.errorType == ErrorTypes::ORDER_ERROR);
        CHECK(*FindReferenceOrNull(refused.violations[0].error, "parameter") == size.limit);
    }
}

TEST_CASE("3.7 A vehicle that accepts numeric ids only rejects other ids")
{
    VehicleOptions options = VehicleSessionFixture::MakeOptions();
    options.factsheet.protocolLimits.maxStringLengths.bIdentifierNumericalOnly = true;
    VehicleSessionFixture bench(options);
    bench.Order(MakeOrder(2, 2, "1"));
    CHECK(bench.HasError(ErrorTypes::ORDER_ERROR));
}

} // namespace ACS::VDA5050::Test
