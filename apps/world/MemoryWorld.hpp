#pragma once

#include "world/FloorContents.hpp"
#include "world/IWorld.hpp"
#include "world/Place.hpp"
#include "world/PlaceList.hpp"
#include "world/WorldStart.hpp"

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Sim
{

/// The floor and its rules (docs/reference/world.md) in the memory of one process. Uses no files, threads or clocks.
class MemoryWorld final : public IWorld
{
public:
    static constexpr std::size_t MAX_CARRIERS = 100'000;
    static constexpr std::size_t MAX_MEMORIES = 1'000'000;
    static constexpr std::size_t MAX_ROBOTS = 10'000;
    static constexpr std::size_t MAX_STATIONS = 100; ///< At which one robot is docked.
    static constexpr std::size_t MAX_EVENTS = 100'000;

private:
    FloorContents _contents;
    PlaceList _places;
    std::set<std::string, std::less<>> _closedSets;
    std::map<std::string, std::set<std::string, std::less<>>, std::less<>>
        _stations; ///< By the robot that is docked there.
    std::deque<WorldEvent> _events;

public:
    /// An empty floor on which every place exists.
    MemoryWorld() = default;

    /// The path of an error is that in the world file: "carriers.TRAY_01".
    [[nodiscard]] static Core::Result<std::unique_ptr<MemoryWorld>> Create(const WorldStart& start);

    [[nodiscard]] Core::Result<void> Act(const WorldEvent& event) override;
    [[nodiscard]] std::optional<std::string> GetCarrierOrNull(std::string_view place) override;
    [[nodiscard]] std::optional<std::string> GetPlaceOrNull(std::string_view carrierID) override;
    [[nodiscard]] EMemory GetMemory(std::string_view place) override;
    [[nodiscard]] bool IsCovered(std::string_view set) override;
    /// Returns at most the last MAX_EVENTS events.
    [[nodiscard]] std::vector<WorldEvent> TakeEvents() override;

    /// The event as it is recorded: in canonical spelling and with the carrier's name. Errors as of Act.
    [[nodiscard]] Core::Result<WorldEvent> Check(const WorldEvent& event) const;
    /// Whether the event changes nothing and need not be recorded. That is the case only for a robot that stays docked.
    [[nodiscard]] bool IsRepeated(const WorldEvent& event) const;

private:
    [[nodiscard]] Core::Result<WorldEvent> CheckEvent(const RobotDocked& docked) const;
    [[nodiscard]] Core::Result<WorldEvent> CheckEvent(const CarrierMoved& moved) const;
    [[nodiscard]] Core::Result<WorldEvent> CheckEvent(const MemoryMoved& moved) const;
    [[nodiscard]] Core::Result<WorldEvent> CheckEvent(const CoverMoved& moved) const;
    [[nodiscard]] Core::Result<WorldEvent> CheckEvent(const ButtonPushed& pushed) const;
    [[nodiscard]] Core::Result<WorldEvent> CheckEvent(const CarrierPlaced& placed) const;
    [[nodiscard]] Core::Result<WorldEvent> CheckEvent(const MemoryPlaced& placed) const;

    void Apply(const RobotDocked& docked);
    void Apply(const CarrierMoved& moved);
    void Apply(const MemoryMoved& moved);
    void Apply(const CoverMoved& moved);
    void Apply(const ButtonPushed& pushed);
    void Apply(const CarrierPlaced& placed);
    void Apply(const MemoryPlaced& placed);

    /// Fails if there is no such place on the floor.
    [[nodiscard]] Core::Result<Place> FindPlace(std::string_view text) const;
    [[nodiscard]] Core::Result<Place> FindKind(
        std::string_view text,
        Core::ESegmentKind kind,
        std::string_view expected) const;
    [[nodiscard]] Core::Result<Place> FindPort(std::string_view text) const;
    [[nodiscard]] Core::Result<Place> FindMemoryPlace(std::string_view text) const;
    [[nodiscard]] Core::Result<Place> FindSet(std::string_view text) const;
    [[nodiscard]] Core::Result<void> CheckReach(std::string_view robotID, const Place& place) const;
    [[nodiscard]] Core::Result<void> CheckCover(const Place& place) const;
    [[nodiscard]] Core::Result<void> CheckFree(const Place& place) const;
};

} // namespace ACS::Sim
