#pragma once

#include <acs/core/Location.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/Plan.hpp>
#include <acs/plan/PortCatalog.hpp>
#include <acs/plan/SiteMap.hpp>

#include <cstddef>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// Whether a job with this effect loads its to (bFills) or unloads its from.
[[nodiscard]] constexpr bool IsPortChanged(EActionEffect effect, bool bFills) noexcept
{
    return effect == EActionEffect::Move || effect == (bFills ? EActionEffect::Load : EActionEffect::Unload);
}

/// The places of a job; a robot's port may still have the alias AMR.
struct ResolvedJob
{
    std::optional<Core::Location> from;
    std::optional<Core::Location> to;
};

struct ResolvedStep
{
    const ActionRule* rule = nullptr; ///< Of the engine's options.
    std::string stationID;
    std::vector<ResolvedJob> jobs;
};

/// A plan with its names resolved on this site.
struct ResolvedPlan
{
    std::vector<ResolvedStep> steps;
    std::vector<std::size_t> candidates; ///< The robots that can execute it; never empty.
};

/// Checks plans against site, robots and actions (section 4.1 of MCS-ACS).
class PlanAdmission
{
    const EngineOptions& _options;
    const SiteMap& _site;
    PortCatalog _catalog;

public:
    PlanAdmission(const EngineOptions& options, const SiteMap& site);

    /// Corrects the case of action names (section 2).
    void SpellActions(Plan& plan) const;

    /// The steps must be in ascending order (SortSteps). The error's path names the field.
    [[nodiscard]] Core::Result<ResolvedPlan> Resolve(const Plan& plan) const;

    /// The node at which a robot of the type docks at the station.
    [[nodiscard]] std::optional<std::size_t> FindDockOrNull(std::string_view stationID, std::string_view vehicleTypeID)
        const;

private:
    [[nodiscard]] Core::Result<ResolvedStep> ResolveStep(const Step& step, const std::string& path) const;
    [[nodiscard]] Core::Result<Core::Location> ResolvePosition(const std::string& text, const std::string& path) const;
    [[nodiscard]] Core::Result<std::optional<Core::Location>> ResolvePlace(
        const std::optional<std::string>& text,
        EPlaceRule rule,
        const Core::Location& position,
        const std::string& path) const;
    [[nodiscard]] bool IsWithinReach(const Core::Location& place, const Core::Location& position) const;
    [[nodiscard]] Core::Result<void> CheckPlace(const Core::Location& place, EPlaceRule rule, const std::string& path)
        const;
    [[nodiscard]] static Core::Result<void> CheckPorts(const Plan& plan, const ResolvedPlan& resolved);
    [[nodiscard]] Core::Result<void> FindCandidates(const Plan& plan, ResolvedPlan& resolved) const;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(
        const RobotOptions& robot,
        const Plan& plan,
        const ResolvedPlan& resolved,
        const std::set<std::string>& namedRobots) const;
};

/// Sorts the steps by stepNo.
void SortSteps(Plan& plan);

} // namespace ACS::Planning
