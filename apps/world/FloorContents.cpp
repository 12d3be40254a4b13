#include "world/FloorContents.hpp"

#include <cassert>
#include <utility>
#include <vector>

namespace ACS::Sim
{
namespace
{

bool IsInside(std::string_view place, std::string_view outer)
{
    return place.starts_with(outer) && (place.size() == outer.size() || place[outer.size()] == '.');
}

/// Removes the entries of the place and of all places inside it from the map and returns them.
template <typename TValue>
std::vector<std::pair<std::string, TValue>> TakeInside(
    std::map<std::string, TValue, std::less<>>& map,
    const std::string& outer)
{
    std::vector<std::pair<std::string, TValue>> taken;
    auto next = map.lower_bound(outer);
    while (next != map.end() && next->first.starts_with(outer))
    {
        const bool bInside = IsInside(next->first, outer);
        if (bInside)
        {
            taken.emplace_back(next->first, std::move(next->second));
        }
        next = bInside ? map.erase(next) : std::next(next);
    }
    return taken;
}

} // namespace

std::optional<std::string> FloorContents::GetCarrierOrNull(std::string_view place) const
{
    const auto found = _carriers.find(place);
    return found == _carriers.end() ? std::nullopt : std::optional(found->second);
}

std::optional<std::string> FloorContents::GetPlaceOrNull(std::string_view carrierID) const
{
    const auto found = _places.find(carrierID);
    return found == _places.end() ? std::nullopt : std::optional(found->second);
}

EMemory FloorContents::GetMemory(std::string_view place) const
{
    const auto found = _memories.find(place);
    return found == _memories.end() ? EMemory::Unknown : found->second;
}

std::optional<std::string> FloorContents::GetObstacleOrNull(std::string_view place) const
{
    for (auto next = _carriers.lower_bound(place); next != _carriers.end() && next->first.starts_with(place); ++next)
    {
        if (IsInside(next->first, place))
        {
            return next->second;
        }
    }
    return std::nullopt;
}

std::size_t FloorContents::GetCarrierCount() const noexcept
{
    return _carriers.size();
}

std::size_t FloorContents::GetMemoryCount() const noexcept
{
    return _memories.size();
}

void FloorContents::Put(const std::string& carrierID, const std::string& place)
{
    assert(!_carriers.contains(place) && !_places.contains(carrierID));
    _carriers.insert_or_assign(place, carrierID);
    _places.insert_or_assign(carrierID, place);
}

void FloorContents::Move(const std::string& from, const std::string& to)
{
    for (auto& [place, carrierID] : TakeInside(_carriers, from))
    {
        std::string moved = to + place.substr(from.size());
        _places.insert_or_assign(carrierID, moved);
        _carriers.insert_or_assign(std::move(moved), std::move(carrierID));
    }
    for (const auto& [place, memory] : TakeInside(_memories, from))
    {
        _memories.insert_or_assign(to + place.substr(from.size()), memory);
    }
}

void FloorContents::Remove(const std::string& place)
{
    for (const auto& [removed, carrierID] : TakeInside(_carriers, place))
    {
        _places.erase(carrierID);
    }
    static_cast<void>(TakeInside(_memories, place));
}

void FloorContents::SetMemory(const std::string& place, EMemory memory)
{
    if (memory == EMemory::Unknown)
    {
        _memories.erase(place);
        return;
    }
    _memories.insert_or_assign(place, memory);
}

} // namespace ACS::Sim
