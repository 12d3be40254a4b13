#pragma once

#include "traffic/Traffic.hpp"
#include "transaction/EngineState.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Where each robot is and may be, and which nodes it therefore holds.
class PlaceTracker
{
    const SiteMap& _site;
    Fleet& _fleet;
    EngineTransaction& _transaction;
    Traffic _traffic;
    std::uint64_t _standingChanges = 1; ///< Grows when a robot stops, starts, or becomes movable or not.

public:
    explicit PlaceTracker(EngineState& engine);

    [[nodiscard]] Alarm MakePlaceAlarm(const Robot& robot, std::string message) const;
    /// A robot that cannot drive now is an obstacle for the others.
    void NoteMovable(const Robot& robot);
    /// Where a robot without a drive is, and where it may still drive on an order that is none of the engine's.
    void Place(Robot& robot);
    /// A robot stops, starts, or becomes movable or not.
    void NoteStandingChanged() noexcept;
    /// Grows with each such change.
    [[nodiscard]] std::uint64_t GetStandingChanges() const noexcept;
    [[nodiscard]] Traffic& GetTraffic() noexcept;
    /// To be stored: where the robot may be after a restart.
    [[nodiscard]] std::vector<std::string> ListNodes(const Robot& robot) const;
    /// Nobody else is let to where a robot may be that has not told it. Those that have told come first.
    void ReservePossibleNodes();
    /// It is not on the floor.
    void ForgetPossibleNodes(Robot& robot);

private:
    /// Somebody has taken it off the map, or it does not know where it is. What it held stays its own until it tells a node.
    void OnPositionLost(Robot& robot);
    /// The node on which it stands first, then those to which it may still go.
    [[nodiscard]] std::vector<std::size_t> ListClaimed(const Robot& robot, std::size_t node) const;
    /// A robot tells that it is there: so nobody is of whom that is only supposed.
    void ReleasePossibleNodes(std::span<const std::size_t> nodes);
    /// Of the way that was written down, what lies behind the node.
    [[nodiscard]] static std::vector<std::size_t> ListPossibleAhead(const Robot& robot, std::size_t node);
};

} // namespace ACS::Planning
