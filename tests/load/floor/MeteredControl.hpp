#pragma once

#include "IFleetControl.hpp"

#include <memory>

namespace ACS::Testing
{

/// Measures the processor time of another control.
class MeteredControl final : public IFleetControl
{
    std::unique_ptr<IFleetControl> _control;
    double& _seconds;

public:
    /// seconds: where the processor time is added; must outlive the control.
    MeteredControl(std::unique_ptr<IFleetControl> control, double& seconds);

    void Submit(Planning::Plan plan, std::uint64_t number, Core::Now now, Planning::EngineActions& out) override;
    void OnEvent(
        const std::string& robotID,
        const Planning::RobotEvent& event,
        Core::Now now,
        Planning::EngineActions& out) override;
    void OnTimer(const Planning::EngineTimer& timer, Core::Now now, Planning::EngineActions& out) override;
    void OnStored(Core::Now now, Planning::EngineActions& out) override;
    void OnReportSent(std::uint64_t sequence, Core::Now now, Planning::EngineActions& out) override;
    [[nodiscard]] std::optional<std::string> GetRobotIDOrNull(const std::string& planID) const override;
};

} // namespace ACS::Testing
