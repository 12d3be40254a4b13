#pragma once

#include "robot/Robot.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Planning
{

/// The robots in the order of the options. Their number never changes.
class Fleet
{
    std::vector<Robot> _robots;
    std::map<std::string, std::size_t, std::less<>> _indices;
    ChangedRobots _changed;

public:
    /// The options must outlive the fleet.
    explicit Fleet(const EngineOptions& options)
        : _robots(options.robots.size())
    {
        for (std::size_t i = 0; i < _robots.size(); ++i)
        {
            _robots[i].index = i;
            _robots[i].options = &options.robots[i];
            _robots[i].ports = PortLedger(options.robots[i].ports);
            _robots[i].changes.SetList(_changed, i);
            _robots[i].changes.MarkStatus();
            _indices.emplace(_robots[i].GetID(), i);
        }
    }

    Fleet(const Fleet&) = delete;
    Fleet& operator=(const Fleet&) = delete;
    Fleet(Fleet&&) = delete;
    Fleet& operator=(Fleet&&) = delete;
    ~Fleet() = default;

    /// The robots with marks, and possibly some whose marks have been removed.
    [[nodiscard]] ChangedRobots& GetChanged() noexcept
    {
        return _changed;
    }

    [[nodiscard]] Robot* FindOrNull(std::string_view robotID)
    {
        const auto found = _indices.find(robotID);
        return found == _indices.end() ? nullptr : &_robots[found->second];
    }

    [[nodiscard]] const Robot* FindOrNull(std::string_view robotID) const
    {
        const auto found = _indices.find(robotID);
        return found == _indices.end() ? nullptr : &_robots[found->second];
    }

    [[nodiscard]] Robot& operator[](std::size_t index)
    {
        return _robots[index];
    }

    [[nodiscard]] const Robot& operator[](std::size_t index) const
    {
        return _robots[index];
    }

    [[nodiscard]] std::size_t size() const noexcept
    {
        return _robots.size();
    }

    [[nodiscard]] auto begin() noexcept
    {
        return _robots.begin();
    }

    [[nodiscard]] auto end() noexcept
    {
        return _robots.end();
    }

    [[nodiscard]] auto begin() const noexcept
    {
        return _robots.begin();
    }

    [[nodiscard]] auto end() const noexcept
    {
        return _robots.end();
    }
};

} // namespace ACS::Planning
