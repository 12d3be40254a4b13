#pragma once

#include "world/WorldEvent.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Sim
{

/// The carriers and memories on the floor, by place. A place that begins with another one and a dot is inside it and is moved
/// and removed with it. Checks no rules: the caller does.
class FloorContents
{
    std::map<std::string, std::string, std::less<>> _carriers; ///< By place.
    std::map<std::string, std::string, std::less<>> _places;   ///< By carrier.
    std::map<std::string, EMemory, std::less<>> _memories;     ///< By place; a missing entry is Unknown.

public:
    [[nodiscard]] std::optional<std::string> GetCarrierOrNull(std::string_view place) const;
    [[nodiscard]] std::optional<std::string> GetPlaceOrNull(std::string_view carrierID) const;
    [[nodiscard]] EMemory GetMemory(std::string_view place) const;
    /// A carrier at the place or inside it; nullopt if the place is free.
    [[nodiscard]] std::optional<std::string> GetObstacleOrNull(std::string_view place) const;
    [[nodiscard]] std::size_t GetCarrierCount() const noexcept;
    [[nodiscard]] std::size_t GetMemoryCount() const noexcept;

    /// The place must be free and the carrier not on the floor.
    void Put(const std::string& carrierID, const std::string& place);
    /// Moves the carrier and all that is inside it; `to` must be free.
    void Move(const std::string& from, const std::string& to);
    /// Removes the carrier and all that is inside it.
    void Remove(const std::string& place);
    void SetMemory(const std::string& place, EMemory memory);
};

} // namespace ACS::Sim
