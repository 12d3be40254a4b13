#pragma once

#include "traffic/Traffic.hpp"
#include "transaction/EngineState.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Planning
{

/// Owns the reservations (Traffic). Decides which nodes a robot without a drive occupies or may occupy, and raises ACS-1003.
class PlaceTracker
{
    const SiteMap& _site;
    Fleet& _fleet;
    EngineTransaction& _transaction;
    Traffic _traffic;
    std::uint64_t _standingChanges = 1; ///< Grows when a robot stops, starts, or becomes movable or not.

public:
    explicit PlaceTracker(EngineState& engine);

    /// ACS-1003
    [[nodiscard]] static Alarm MakePlaceAlarm(const Robot& robot, std::string message);
    /// The node of these on the way to which the robot is stationary; nullopt if it is on its node or drives.
    [[nodiscard]] static std::optional<std::size_t> GetHeadingOrNull(
        const Robot& robot,
        std::span<const std::size_t> ahead);
    /// Whether the robot, whose last known node is this one, may be anywhere on the nodes ahead: its state has no pose, and either
    /// another last node, or there was a pose before. The nodes are held as without a state, until it has a pose.
    [[nodiscard]] static bool IsPoseLost(const Robot& robot, std::string_view nodeID);
    /// Updates whether the robot can drive; one that cannot is a fixed obstacle.
    void NoteMovable(const Robot& robot);
    /// The same of all robots.
    void NoteAllMovable();
    /// Reserves the node of a robot without a drive, and the nodes it may still reach on an order of another master.
    void Place(Robot& robot);
    /// A robot has stopped or started.
    void NoteStandingChanged() noexcept;
    /// Increases when a robot stops, starts, or becomes movable or not.
    [[nodiscard]] std::uint64_t GetStandingChanges() const noexcept;
    [[nodiscard]] Traffic& GetTraffic() noexcept;
    [[nodiscard]] const Traffic& GetTraffic() const noexcept;
    /// The nodes where the robot may be after a restart; stored.
    [[nodiscard]] std::vector<std::string> ListNodes(const Robot& robot) const;
    /// Reserves the possible nodes of robots without a reported position. Reported positions take precedence.
    void ReservePossibleNodes();
    /// The robot is not on the floor: its possible nodes are released.
    void ForgetPossibleNodes(Robot& robot);

private:
    [[nodiscard]] std::optional<std::size_t> FindNodeOrNull(const Robot& robot) const;
    /// The robot reports no node of the map. Its reservations stay until it reports one.
    void OnPositionLost(Robot& robot);
    /// The robot's node, then the nodes to which it may still drive.
    [[nodiscard]] std::vector<std::size_t> ListClaimed(const Robot& robot, std::size_t node) const;
    /// Another robot has reported these nodes: no robot can be there that only may be.
    void ReleasePossibleNodes(std::span<const std::size_t> nodes);
    /// The nodes to which a robot without a drive may have continued from this node: of its last drive, or as stored.
    [[nodiscard]] static std::vector<std::size_t> ListSupposedAhead(const Robot& robot, std::size_t node);
};

} // namespace ACS::Planning
