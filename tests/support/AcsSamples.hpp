#pragma once

#include <acs/protocol/AcsMessage.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

namespace ACS::Testing
{

/// "TP07"
inline std::string MakeElement(const char* prefix, std::size_t number)
{
    return prefix + std::string(number < 10 ? "0" : "") + std::to_string(number);
}

/// A plan of the maximum size: a control robot carries 75 samples from its three trays into sets of 25.
inline Protocol::AcsRequest MakeLargePlan()
{
    Protocol::ExecutionPlan plan{"PLAN-20250702-075", "LOT-20250702-12", 10, {}};
    for (std::size_t set = 1; set <= 3; ++set)
    {
        const std::string place = MakeElement("A01.SET", set);
        Protocol::PlanStep step{static_cast<std::int32_t>(set), "MemoryPickAndPlace", place, {}, {}};
        for (std::size_t sample = 1; sample <= 25; ++sample)
        {
            const std::string number = std::to_string(set * 1000 + sample);
            step.jobs.push_back(
                {"d3324f09-00b8-1e3a-2c0a-aa1cd7c8" + number,
                 MakeElement("AMR.TP", set) + MakeElement(".MP", sample),
                 place + MakeElement(".MP", sample)});
        }
        plan.steps.push_back(std::move(step));
    }
    return {
        "e2a97f63-4ed2-4d85-a2b3-11a51c188111",
        {Core::WallTime(std::chrono::milliseconds(1'751'457'600'123)), std::chrono::hours(9)},
        std::move(plan)};
}

/// The positions of fifty robots, to the millimetre and the tenth of a degree.
inline Protocol::AcsRequest MakeFiftyPositions()
{
    Protocol::RobotPositionUpdate update;
    for (std::size_t robot = 1; robot <= 50; ++robot)
    {
        const auto step = static_cast<double>(robot);
        update.robots.push_back(
            {MakeElement("LR", robot), 10.241 + step * 1.375, -3.5 + step * 0.873, step * 7.1, 100.0 - step});
    }
    return {
        "b332fcbe-8916-4cd8-9ebc-2d6c76082b2c",
        {Core::WallTime(std::chrono::milliseconds(1'751'457'600'123)), std::chrono::hours(9)},
        std::move(update)};
}

} // namespace ACS::Testing
