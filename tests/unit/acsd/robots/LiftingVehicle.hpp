#pragma once

#include "robots/VehicleFixture.hpp"
#include <acs/plan/LifReader.hpp>
#include <acs/plan/Router.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Acsd::Test
{

/// N1 - E1 - N2 - E2 - N3, 3 m each, with these members in the rule of N2 and in that of E1.
inline std::string MakeMap(const std::string& nodeMembers, const std::string& edgeMembers)
{
    std::string nodes;
    for (const std::string number : {"1", "2", "3"})
    {
        nodes += (nodes.empty() ? "" : ", ") + (R"({"nodeId": "N)" + number)
            + R"(", "mapId": "floor", "nodePosition": {"x": )" + std::to_string(3 * (std::stoi(number) - 1))
            + R"(, "y": 0}, "vehicleTypeNodeProperties": [{"vehicleTypeId": "lr")"
            + (number == "2" && !nodeMembers.empty() ? ", " + nodeMembers : "") + "}]}";
    }
    std::string edges;
    for (const auto& [number, next] : {std::pair("1", "2"), std::pair("2", "3")})
    {
        const bool bFirst = edges.empty();
        edges += (bFirst ? "" : ", ") + (R"({"edgeId": "E)" + std::string(number)) + R"(", "startNodeId": "N)" + number
            + R"(", "endNodeId": "N)" + next + R"(", "vehicleTypeEdgeProperties": [{"vehicleTypeId": "lr")"
            + (bFirst && !edgeMembers.empty() ? ", " + edgeMembers : "") + "}]}";
    }
    return R"({"metaInformation": {"projectIdentification": "p", "creator": "c", "exportTimestamp": "2025-01-01T00:00:00Z",
        "lifVersion": "1.0.0"}, "layouts": [{"layoutId": "one", "layoutVersion": "1", "nodes": [)"
        + nodes + R"(], "edges": [)" + edges + R"(], "stations": []}]})";
}

/// A drive from N1 to N3 on that map.
inline Planning::Drive MakeMapDrive(
    const std::string& nodeMembers,
    const std::string& edgeMembers,
    std::string driveID = "3f2a7c10-5b6d-4e8f-9a0b-1c2d3e4f5061")
{
    const Core::Result<Planning::SiteMap> site = Planning::DecodeLIF(MakeMap(nodeMembers, edgeMembers));
    REQUIRE(site);
    const std::optional<Planning::Route> route = Planning::Router(*site).FindRouteOrNull("lr", "N1", "N3");
    REQUIRE(route.has_value());
    return {std::move(driveID), *route, 2};
}

/// The vehicle on its way from N1 to N3, or to N2 only, with the action "lift" on N2 and on E1.
struct LiftingVehicle : VehicleFixture
{
    const std::string lift =
        R"("actions": [{"actionType": "lift", "requirementType": "REQUIRED", "blockingType": "HARD"}])";
    VDA5050::OrderMessage order;

    explicit LiftingVehicle(std::size_t nodeCount = 3)
    {
        state.lastNodeID = "N1";
        ComeOnline();
        Planning::Drive drive = MakeMapDrive(lift, lift, "D1");
        drive.route.nodes.resize(nodeCount);
        drive.route.edges.resize(nodeCount - 1);
        drive.releasedCount = nodeCount;
        Command(drive);
        order = TakeOrders().at(0);
        ShowOrder(order, nodeCount == 2 ? std::vector<std::string>{"N2"} : std::vector<std::string>{"N2", "N3"});
        state.actionStates = {
            MakeState("D1-1-0", VDA5050::EActionStatus::Waiting),
            MakeState("D1-2-0", VDA5050::EActionStatus::Waiting)};
        ShowState();
        actions.clear();
    }

    static VDA5050::ActionState MakeState(std::string actionID, VDA5050::EActionStatus status)
    {
        VDA5050::ActionState action;
        action.actionID = std::move(actionID);
        action.actionType = "lift";
        action.actionStatus = status;
        return action;
    }

    /// On N2, with the edge's action finished and this status of the node's action.
    void ShowAtNode(VDA5050::EActionStatus status)
    {
        ShowOrder(order, {"N3"});
        ShowAt("N2", 2);
        state.actionStates = {MakeState("D1-1-0", VDA5050::EActionStatus::Finished), MakeState("D1-2-0", status)};
        ShowState();
    }

    /// It was restarted on N2.
    void LoseOrder()
    {
        state.orderID.clear();
        state.nodeStates.clear();
        state.actionStates.clear();
        ShowState();
        REQUIRE(TakeEvents<Planning::DriveRejected>().size() == 1);
    }

    /// With the order that repeats the action for a job. The vehicle has received it and shows nothing of it.
    VDA5050::OrderMessage BeginRepetition()
    {
        ShowAtNode(VDA5050::EActionStatus::Running);
        LoseOrder();
        Command(MakeJob("CassetteLoad"));
        return TakeOrders().at(0);
    }

    void ShowRepetition(const VDA5050::OrderMessage& repetition, VDA5050::EActionStatus status)
    {
        ShowOrder(repetition, {});
        ShowAt("N2", 0);
        state.actionStates = {MakeState(repetition.nodes[0].actions[0].actionID, status)};
        ShowState();
    }

    /// The cancelOrder that was sent, as finished.
    void ShowCancelled()
    {
        VDA5050::InstantActionsMessage cancel;
        for (const VDA5050::MqttMessage& message : outputs.messages)
        {
            if (message.topic.ends_with("/instantActions"))
            {
                cancel = *codec.Decode<VDA5050::InstantActionsMessage>(message.payload);
            }
        }
        REQUIRE(cancel.actions.size() == 1);
        state.actionStates.push_back(MakeState(cancel.actions[0].actionID, VDA5050::EActionStatus::Finished));
        state.actionStates.back().actionType = cancel.actions[0].actionType;
        ShowState();
    }

    /// From N2 to N3, released at N2.
    [[nodiscard]] Planning::Drive MakeNextDrive() const
    {
        Planning::Drive next = MakeMapDrive(lift, lift, "D2");
        next.route.nodes.erase(next.route.nodes.begin());
        next.route.edges.erase(next.route.edges.begin());
        next.releasedCount = 1;
        return next;
    }

    /// On N3, where the drive ends.
    void ShowAtEnd()
    {
        ShowOrder(order, {});
        ShowAt("N3", 4);
        ShowState();
    }
};

} // namespace ACS::Acsd::Test
