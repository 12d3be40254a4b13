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

/// Which carrier is at which place, and what memory places hold. A place that begins with another one and a dot is inside it:
/// what is inside moves along and goes with it. Checks no rules.
class FloorContents
{
    std::map<std::string, std::string, std::less<>> _carriers; ///< By place.
    std::map<std::string, std::string, std::less<>> _places;   ///< By carrier.
    std::map<std::string, EMemory, std::less<>> _memories;     ///< By place; unknown where there is none.

public:
    [[nodiscard]] std::optional<std::string> GetCarrierOrNull(std::string_view place) const;
    [[nodiscard]] std::optional<std::string> GetPlaceOrNull(std::string_view carrierID) const;
    [[nodiscard]] EMemory GetMemory(std::string_view place) const;
    /// A carrier that is at the place or inside it; nullopt: it is free.
    [[nodiscard]] std::optional<std::string> GetObstacleOrNull(std::string_view place) const;
    [[nodiscard]] std::size_t GetCarrierCount() const noexcept;
    [[nodiscard]] std::size_t GetMemoryCount() const noexcept;

    /// The place is free, and the carrier nowhere.
    void Put(const std::string& carrierID, const std::string& place);
    /// All that is at the one place and inside it; the other one is free.
    void Move(const std::string& from, const std::string& to);
    /// All that is at the place and inside it.
    void Remove(const std::string& place);
    void SetMemory(const std::string& place, EMemory memory);
};

} // namespace ACS::Sim
