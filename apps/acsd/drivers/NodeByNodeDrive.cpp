#include <acs/acsd/NodeByNodeDrive.hpp>
#include <acs/core/Overloaded.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/RobotEvent.hpp>

#include <utility>
#include <variant>
#include <vector>

namespace ACS::Acsd
{

void NodeByNodeDrive::Handle(const Planning::RobotCommand& command)
{
    std::visit(
        Core::Overloaded{
            [this](const Planning::Drive& drive) {
                _drive = drive;
                _passed = 0;
                _bCancelling = false;
            },
            [this](const Planning::ExtendDrive& extend) {
                if (_drive.has_value() && _drive->driveID == extend.driveID) // it may just have been rejected
                {
                    _drive->releasedCount = extend.releasedCount;
                }
            },
            [this](const Planning::CancelDrive& cancel) {
                _bCancelling = _drive.has_value() && _drive->driveID == cancel.driveID;
            },
            [this](const Planning::Pause& /*pause*/) { _bPaused = true; },
            [this](const Planning::Resume& /*resume*/) { _bPaused = false; },
            [](const auto& /*other*/) {
            }},
        command);
}

void NodeByNodeDrive::OnStationary(const std::string& nodeID, Planning::AdapterActions& out)
{
    if (!_drive.has_value())
    {
        return;
    }
    const std::string driveID = _drive->driveID;
    const std::vector<Planning::RouteNode>& nodes = _drive->route.nodes;
    if (_passed < nodes.size() && nodes[_passed].nodeID == nodeID)
    {
        out.emplace_back(Planning::RaiseEvent{Planning::NodePassed{driveID, nodeID}});
        ++_passed;
    }
    std::optional<Planning::RobotEvent> end;
    if (_passed == 0 || nodes[_passed - 1].nodeID != nodeID)
    {
        end = Planning::DriveRejected{driveID, "the robot is at " + Core::QuoteForError(nodeID)};
    }
    else if (_passed == nodes.size())
    {
        end = Planning::Arrived{driveID};
    }
    else if (_bCancelling)
    {
        end = Planning::DriveCancelled{driveID, nodeID};
    }
    if (end.has_value())
    {
        out.emplace_back(Planning::RaiseEvent{std::move(*end)});
        _drive.reset();
    }
}

std::optional<NodeByNodeDrive::Step> NodeByNodeDrive::GetStepOrNull() const
{
    if (!_drive.has_value() || _bPaused || _bCancelling || _passed == 0 || _passed >= _drive->releasedCount
        || _passed >= _drive->route.nodes.size())
    {
        return std::nullopt;
    }
    return Step{_drive->driveID, _drive->route.nodes[_passed].nodeID};
}

bool NodeByNodeDrive::HasDrive() const noexcept
{
    return _drive.has_value();
}

bool NodeByNodeDrive::IsPaused() const noexcept
{
    return _bPaused;
}

} // namespace ACS::Acsd
