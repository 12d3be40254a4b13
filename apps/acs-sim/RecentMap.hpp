#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::AcsSim
{

/// A map that forgets its oldest entries, so that a run of any length needs a limited memory.
template <typename TValue>
class RecentMap
{
public:
    static constexpr std::size_t MOST_ENTRIES = 4096;

private:
    std::map<std::string, TValue, std::less<>> _entries;
    std::deque<std::string> _order; ///< Keys, oldest first.

public:
    /// The entry of the key, and whether it is new. Pointers to other entries may become invalid.
    std::pair<TValue*, bool> Add(const std::string& key, TValue value)
    {
        const auto [entry, bNew] = _entries.try_emplace(key, std::move(value));
        if (bNew)
        {
            _order.push_back(key);
            if (_order.size() > MOST_ENTRIES)
            {
                _entries.erase(_order.front());
                _order.pop_front();
            }
        }
        return {&entry->second, bNew};
    }

    [[nodiscard]] TValue* FindOrNull(std::string_view key)
    {
        const auto found = _entries.find(key);
        return found == _entries.end() ? nullptr : &found->second;
    }

    [[nodiscard]] const TValue* FindOrNull(std::string_view key) const
    {
        const auto found = _entries.find(key);
        return found == _entries.end() ? nullptr : &found->second;
    }

    /// In the order of the keys.
    [[nodiscard]] std::map<std::string, TValue, std::less<>>& GetEntries()
    {
        return _entries;
    }

    [[nodiscard]] const std::map<std::string, TValue, std::less<>>& GetEntries() const
    {
        return _entries;
    }
};

} // namespace ACS::AcsSim
