#pragma once

#include <acs/vda5050/OrderMessage.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ACS::VDA5050
{

/// The rest of an order: its remaining edges and nodes, each edge with its end node. Rarely used members are stored
/// separately, so that a route needs less than half the memory of its message: one process may hold the long routes of
/// hundreds of vehicles. Only for valid orders.
class RemainingRoute
{
    /// Rarely used members of a node.
    struct NodeExtras
    {
        std::string nodeDescription;
        std::string mapDescription;
        std::vector<Action> actions;

        bool operator==(const NodeExtras&) const = default;
    };

    struct EdgeExtras
    {
        std::string edgeDescription;
        std::string direction;
        std::optional<double> maxHeight;
        std::optional<double> minHeight;
        std::optional<Trajectory> trajectory;
        std::optional<Corridor> corridor;
        std::vector<Action> actions;

        bool operator==(const EdgeExtras&) const = default;
    };

    struct Position
    {
        double x = 0.0;
        double y = 0.0;
        std::optional<double> theta;
        std::optional<double> allowedDeviationXY;
        std::optional<double> allowedDeviationTheta;
        std::string mapID;
    };

    struct Step
    {
        std::string edgeID;
        std::string nodeID;
        std::uint32_t edgeSequenceID = 0;
        std::uint32_t nodeSequenceID = 0;
        std::optional<double> maxSpeed;
        std::optional<double> orientation;
        std::optional<double> maxRotationSpeed;
        std::optional<double> length;
        std::optional<EOrientationType> orientationType;
        std::optional<bool> bRotationAllowed;
        bool bEdgeReleased = false;
        bool bNodeReleased = false;
        std::optional<Position> position;
        std::unique_ptr<EdgeExtras> edgeExtrasOrNull;
        std::unique_ptr<NodeExtras> nodeExtrasOrNull;
    };

    std::deque<Step> _steps;
    std::size_t _released = 0; ///< Number of released steps, which come first.
    std::size_t _bytes = 0;    ///< Maximum size of the released steps in a state.
    std::string _startNodeID;  ///< Start node of the first edge.

public:
    /// Appends the order without its first node.
    void Append(OrderMessage order);
    /// Removes the first edge and node.
    void DropFront();
    /// Removes all edges and nodes except for the first ones.
    void Cut(std::size_t size);
    /// Removes the actions of the first node, which still has to be reached.
    void DropFrontActions();
    /// False if there is no such edge, if it already has a trajectory, or if a state has no room for it.
    bool TrySetTrajectory(std::uint32_t edgeSequenceID, Trajectory trajectory);
    void Clear();

    [[nodiscard]] bool IsEmpty() const noexcept;
    [[nodiscard]] std::size_t GetSize() const noexcept;
    /// Number of released nodes; the base comes first.
    [[nodiscard]] std::size_t CountReleased() const;
    /// Maximum size of the released part in a state.
    [[nodiscard]] std::size_t GetReleasedBytes() const;

    // The index must be below GetSize. Edge n leads to node n.
    [[nodiscard]] OrderEdge GetEdge(std::size_t index) const;
    [[nodiscard]] OrderNode GetNode(std::size_t index) const;
    [[nodiscard]] const std::string& GetEdgeID(std::size_t index) const;
    [[nodiscard]] bool HasCorridor(std::size_t index) const;
    [[nodiscard]] const std::string& GetNodeID(std::size_t index) const;
    [[nodiscard]] std::uint32_t GetNodeSequenceID(std::size_t index) const;
    [[nodiscard]] std::uint32_t GetEdgeSequenceID(std::size_t index) const;
    [[nodiscard]] std::span<const Action> GetNodeActions(std::size_t index) const;
    [[nodiscard]] std::span<const Action> GetEdgeActions(std::size_t index) const;
    /// As states show them.
    [[nodiscard]] NodeState GetNodeState(std::size_t index) const;
    [[nodiscard]] EdgeState GetEdgeState(std::size_t index) const;

private:
    [[nodiscard]] static Step MakeStep(OrderEdge edge, OrderNode node);
    [[nodiscard]] const std::string& GetStartNodeID(std::size_t index) const;
    [[nodiscard]] std::size_t Measure(std::size_t index) const;
};

} // namespace ACS::VDA5050
