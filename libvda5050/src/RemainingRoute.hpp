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

/// What a vehicle keeps of an order: the edges and nodes that are still to come, each edge with the node that it leads
/// to. Takes less than half of the messages' own room, as what most routes leave out lies apart: a fleet of hundreds in
/// one process holds long ones. For orders without violations.
class RemainingRoute
{
    /// What only some nodes and edges have.
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
    std::size_t _released = 0; ///< They come first.
    std::size_t _bytes = 0;    ///< In a state, at most.
    std::string _startNodeID;  ///< Where the first edge begins.

    [[nodiscard]] static Step MakeStep(OrderEdge edge, OrderNode node);
    [[nodiscard]] const std::string& GetStartNodeID(std::size_t index) const;
    [[nodiscard]] std::size_t Measure(std::size_t index) const;

public:
    /// All of the order but its first node.
    void Append(OrderMessage order);
    /// Forgets the first edge and node.
    void DropFront();
    /// Forgets all from this number on.
    void Cut(std::size_t size);
    /// The first node is only to be reached: its actions are forgotten.
    void DropFrontActions();
    /// False where there is no such edge, where it has a trajectory already, and where a state has no room for it.
    bool TrySetTrajectory(std::uint32_t edgeSequenceID, Trajectory trajectory);
    void Clear();

    [[nodiscard]] bool IsEmpty() const noexcept;
    [[nodiscard]] std::size_t GetSize() const noexcept;
    /// How many nodes are released; the base comes first.
    [[nodiscard]] std::size_t CountReleased() const;
    /// What the released part takes in a state, at most.
    [[nodiscard]] std::size_t GetReleasedBytes() const;

    // Of an index below GetSize: edge n leads to node n.
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
};

} // namespace ACS::VDA5050
