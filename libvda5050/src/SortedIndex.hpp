#pragma once

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

namespace ACS::VDA5050
{

/// Finds elements of a list by a key, with n log n also for adversarial keys. Of a repeated key the first element is found.
/// Refers to the list, which must neither move nor change meanwhile.
template <typename TItem, typename TKey = std::identity>
class SortedIndex
{
    TKey _getKey;
    std::vector<const TItem*> _items;

public:
    explicit SortedIndex(const std::vector<TItem>& items, TKey getKey = {})
        : _getKey(std::move(getKey))
    {
        _items.reserve(items.size());
        for (const TItem& item : items)
        {
            _items.push_back(&item);
        }
        std::ranges::stable_sort(
            _items,
            {},
            [this](const TItem* item) -> const auto& { return std::invoke(_getKey, *item); });
    }

    template <typename TWanted>
    [[nodiscard]] const TItem* FindOrNull(const TWanted& wanted) const
    {
        const auto found = std::ranges::lower_bound(
            _items,
            wanted,
            {},
            [this](const TItem* item) -> const auto& { return std::invoke(_getKey, *item); });
        return found != _items.end() && std::invoke(_getKey, **found) == wanted ? *found : nullptr;
    }
};

} // namespace ACS::VDA5050
