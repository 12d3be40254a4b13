#pragma once

#include <acs/core/Now.hpp>
#include <acs/plan/EngineAction.hpp>
#include <acs/plan/Plan.hpp>
#include <acs/plan/RobotEvent.hpp>

#include <cstdint>
#include <optional>
#include <string>

namespace ACS::Testing
{

/// What controls the vehicles of a FleetWorld: the engine, or a rule that it is compared with. Appends its actions to out.
class IFleetControl
{
public:
    IFleetControl() = default;
    IFleetControl(const IFleetControl&) = delete;
    IFleetControl& operator=(const IFleetControl&) = delete;
    virtual ~IFleetControl() = default;

    virtual void Submit(Planning::Plan plan, std::uint64_t number, Core::Now now, Planning::EngineActions& out) = 0;
    virtual void OnEvent(
        const std::string& robotID,
        const Planning::RobotEvent& event,
        Core::Now now,
        Planning::EngineActions& out) = 0;
    virtual void OnTimer(const Planning::EngineTimer& timer, Core::Now now, Planning::EngineActions& out) = 0;
    virtual void OnStored(Core::Now now, Planning::EngineActions& out) = 0;
    virtual void OnReportSent(std::uint64_t sequence, Core::Now now, Planning::EngineActions& out) = 0;
    [[nodiscard]] virtual std::optional<std::string> GetRobotIDOrNull(const std::string& planID) const = 0;
};

} // namespace ACS::Testing
