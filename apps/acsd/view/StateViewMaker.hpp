#pragma once

#include "view/ProgramState.hpp"
#include "view/StateView.hpp"
#include <acs/core/Now.hpp>
#include <acs/plan/PlanEngine.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

/// Makes the views of the present state, and notes since when each plan waits, each alarm is set and each link is as it is. Pure.
class StateViewMaker final
{
    /// Time since which something is the case.
    using Since = std::map<std::string, Core::WallTime, std::less<>>;

    const Planning::PlanEngine& _engine;
    Core::WallTime _startedAt;
    std::vector<Planning::Block> _blocks; ///< Of the last view.
    std::uint64_t _siteRevision = 0;
    Since _waits;  ///< By planID.
    Since _alarms; ///< By robot, code, plan and job.
    std::map<std::string, std::pair<bool, Core::WallTime>, std::less<>> _links;

public:
    /// The engine must outlive the maker.
    StateViewMaker(const Planning::PlanEngine& engine, Core::WallTime startedAt);

    /// Call it at least once a second while acsd runs: the times are as exact as the calls are frequent.
    [[nodiscard]] StateView Make(const ProgramState& program, Core::WallTime now);

private:
    [[nodiscard]] StatusView MakeStatus(const ProgramState& program, Core::WallTime now);
    [[nodiscard]] std::vector<PlanView> MakePlans(Core::WallTime now);
    [[nodiscard]] std::vector<AlarmView> MakeAlarms(Core::WallTime now);
    [[nodiscard]] std::vector<RobotView> MakeRobots(const ProgramState& program) const;
};

} // namespace ACS::Acsd
