#pragma once

#include "world/WorldEvent.hpp"
#include <acs/core/Result.hpp>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Sim
{

/// The physical floor, shared by all simulators of a site: carriers in ports, memories in places, positions of covers. Locations
/// are canonical texts that name the robot ("CR01.TP01").
class IWorld
{
public:
    IWorld() = default;
    IWorld(const IWorld&) = delete;
    IWorld& operator=(const IWorld&) = delete;
    virtual ~IWorld() = default;

    /// Executes the event if it is physically possible. Otherwise nothing changes and the error states the reason: `from` is
    /// empty, `to` is occupied, the place has another carrier than the named one, the cover is closed, the place is out of the
    /// robot's reach or does not exist.
    [[nodiscard]] virtual Core::Result<void> Act(const WorldEvent& event) = 0;

    /// The carrier at the place; nullopt if there is none.
    [[nodiscard]] virtual std::optional<std::string> GetCarrierOrNull(std::string_view place) = 0;
    /// The place of the carrier; nullopt if it is not on the floor.
    [[nodiscard]] virtual std::optional<std::string> GetPlaceOrNull(std::string_view carrierID) = 0;
    [[nodiscard]] virtual EMemory GetMemory(std::string_view place) = 0;
    [[nodiscard]] virtual bool IsCovered(std::string_view set) = 0;

    /// All events of all processes since the last call, or since this object was created, in their order.
    [[nodiscard]] virtual std::vector<WorldEvent> TakeEvents() = 0;

    /// Why the last call could not read the events of other processes; nullopt if it read all of them.
    [[nodiscard]] virtual std::optional<Core::Error> GetFailureOrNull() const
    {
        return std::nullopt;
    }
};

} // namespace ACS::Sim
