#pragma once

#include "robot/ChangedRobots.hpp"

#include <cstddef>
#include <utility>

namespace ACS::Planning
{

/// What may have changed of a robot since it was published and stored.
class RobotChanges
{
    ChangedRobots* _listOrNull = nullptr; ///< Of its fleet.
    std::size_t _robot = 0;
    bool _bStatus = false;
    bool _bWork = false; ///< Its WorkRecord.

public:
    /// The list must outlive the robot.
    void SetList(ChangedRobots& list, std::size_t robot) noexcept
    {
        _listOrNull = &list;
        _robot = robot;
    }

    void MarkStatus(bool bChanged = true)
    {
        if (bChanged && !std::exchange(_bStatus, true) && _listOrNull != nullptr)
        {
            _listOrNull->status.push_back(_robot);
        }
    }

    void MarkWork(bool bChanged = true)
    {
        if (bChanged && !std::exchange(_bWork, true) && _listOrNull != nullptr)
        {
            _listOrNull->work.push_back(_robot);
        }
    }

    [[nodiscard]] bool IsStatusMarked() const noexcept
    {
        return _bStatus;
    }

    [[nodiscard]] bool IsWorkMarked() const noexcept
    {
        return _bWork;
    }

    /// Removes the mark. Returns whether there was one.
    [[nodiscard]] bool TryUnmarkStatus() noexcept
    {
        return std::exchange(_bStatus, false);
    }

    [[nodiscard]] bool TryUnmarkWork() noexcept
    {
        return std::exchange(_bWork, false);
    }
};

} // namespace ACS::Planning
