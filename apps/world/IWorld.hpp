#pragma once

#include "world/WorldEvent.hpp"
#include <acs/core/Result.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Sim
{

/// What the simulated equipment knows of the physical floor: which carrier is in which port, memory in which place, cover in
/// which position. Shared by all simulators of a floor. Locations are canonical texts that name the robot ("CR01.TP01").
class IWorld
{
public:
    IWorld() = default;
    IWorld(const IWorld&) = delete;
    IWorld& operator=(const IWorld&) = delete;
    virtual ~IWorld() = default;

    /// Does it, if it is physically possible; else nothing happens, and the error says why: `from` is empty, `to` is occupied,
    /// another carrier is there than the one that is named, the cover is closed, the place is out of the robot's reach or does
    /// not exist.
    [[nodiscard]] virtual Core::Result<void> Act(const WorldEvent& event) = 0;

    /// What is at the place at present; nullopt: nothing.
    [[nodiscard]] virtual std::optional<std::string> GetCarrierOrNull(std::string_view place) = 0;
    /// Where the carrier is at present; nullopt: nowhere on the floor.
    [[nodiscard]] virtual std::optional<std::string> GetPlaceOrNull(std::string_view carrierID) = 0;
    [[nodiscard]] virtual EMemory GetMemory(std::string_view place) = 0;
    [[nodiscard]] virtual bool IsCovered(std::string_view set) = 0;

    /// Every event since the last call, or since this object exists, of all processes, in the order in which they happened.
    [[nodiscard]] virtual std::vector<WorldEvent> TakeEvents() = 0;

    /// Why the last call did not see what other processes did; nullopt: it saw everything.
    [[nodiscard]] virtual std::optional<Core::Error> GetFailureOrNull() const
    {
        return std::nullopt;
    }
};

} // namespace ACS::Sim
