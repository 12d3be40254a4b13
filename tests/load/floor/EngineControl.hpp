#pragma once

#include "Floor.hpp"
#include "IFleetControl.hpp"
#include "SeededRandom.hpp"
#include <acs/plan/PlanEngine.hpp>

#include <chrono>
#include <cstddef>

namespace ACS::Testing
{

/// The engine, as acsd uses it.
class EngineControl final : public IFleetControl
{
    SeededRandom _random;
    Planning::PlanEngine _engine;

public:
    /// Overtaking is EngineOptions::queueOvertaking.
    EngineControl(const Floor& floor, std::size_t vehicles, std::chrono::milliseconds overtaking = {});

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
