#include "OrderNumbers.hpp"

#include <algorithm>
#include <limits>
#include <utility>

namespace ACS::VDA5050
{

OrderNumbers::OrderNumbers(std::uint32_t lastID, std::vector<std::uint32_t> continuedIDs)
    : _lastID(lastID),
      _continuedIDs(std::move(continuedIDs))
{
}

std::optional<std::uint32_t> OrderNumbers::TakeOrNull(std::uint32_t shownID)
{
    const std::uint32_t lastID = std::max(_lastID, shownID);
    if (lastID == std::numeric_limits<std::uint32_t>::max())
    {
        return std::nullopt;
    }
    _lastID = lastID + 1;
    return _lastID;
}

void OrderNumbers::SetContinued(std::uint32_t updateID)
{
    _continuedIDs.push_back(updateID);
}

bool OrderNumbers::TryRenumber(std::uint32_t& updateID, std::uint32_t shownID)
{
    const std::optional<std::uint32_t> nextID = TakeOrNull(shownID);
    if (nextID.has_value())
    {
        std::ranges::replace(_continuedIDs, updateID, *nextID);
        updateID = *nextID;
    }
    return nextID.has_value();
}

void OrderNumbers::Accept(std::uint32_t updateID)
{
    _acceptedIDOrNull = updateID;
    _lastID = std::max(_lastID, updateID);
    std::erase_if(_continuedIDs, [updateID](std::uint32_t continuedID) { return continuedID < updateID; });
}

bool OrderNumbers::IsAccepted() const noexcept
{
    return _acceptedIDOrNull.has_value();
}

bool OrderNumbers::IsContinued() const
{
    return _acceptedIDOrNull.has_value() && std::ranges::count(_continuedIDs, *_acceptedIDOrNull) > 0;
}

} // namespace ACS::VDA5050
