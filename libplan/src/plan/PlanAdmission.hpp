#pragma once

#include <acs/core/Location.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/Plan.hpp>
#include <acs/plan/PortCatalog.hpp>
#include <acs/plan/SiteMap.hpp>

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <span>
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
    std::span<const std::size_t> candidates; ///< The robots that can execute it; never empty. Kept by PlanAdmission.
};

/// Checks plans against site, robots and actions (sections 6.3 and 6.4 of MCS-ACS).
class PlanAdmission
{
    const EngineOptions& _options;
    const SiteMap& _site;
    PortCatalog _catalog;
    std::map<std::string, std::size_t, std::less<>> _robots; ///< By name.
    /// Robots that can execute the same plans, except those that name a robot. A plan is compared with one of each.
    std::vector<std::vector<std::size_t>> _classes;
    /// The lists to which plans refer: by the classes that can execute a plan, and of one robot each.
    mutable std::map<std::vector<bool>, std::vector<std::size_t>> _candidates;
    mutable std::map<std::size_t, std::vector<std::size_t>> _named;

public:
    /// Both must outlive the object.
    PlanAdmission(const EngineOptions& options, const SiteMap& site);
    PlanAdmission(const PlanAdmission&) = delete;
    PlanAdmission& operator=(const PlanAdmission&) = delete;
    PlanAdmission(PlanAdmission&&) = delete;
    PlanAdmission& operator=(PlanAdmission&&) = delete;
    ~PlanAdmission() = default;

    /// Corrects the case of action names (section 2).
    void SpellActions(Plan& plan) const;

    /// The steps must be in ascending order (SortSteps). The error's path names the field. The object must outlive the result.
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
    void FindClasses();
    [[nodiscard]] Core::Result<void> FindCandidates(const Plan& plan, ResolvedPlan& resolved) const;
    [[nodiscard]] std::span<const std::size_t> ListCandidates(
        const Plan& plan,
        const ResolvedPlan& resolved,
        const std::set<std::string>& namedRobots) const;
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(
        const RobotOptions& robot,
        const Plan& plan,
        const ResolvedPlan& resolved,
        const std::set<std::string>& namedRobots) const;
};

/// Sorts the steps by stepNo.
void SortSteps(Plan& plan);

} // namespace ACS::Planning
