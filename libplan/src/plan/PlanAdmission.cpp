#include "plan/PlanAdmission.hpp"

#include "plan/PlaceRule.hpp"
#include <acs/core/ControlCharacter.hpp>
#include <acs/core/ECoreError.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <string_view>
#include <utility>

namespace ACS::Planning
{

namespace
{

using Core::ECoreError;

constexpr std::size_t MAXIMUM_STEPS = 1'000;
constexpr std::size_t MAXIMUM_JOBS = 1'000;

tl::unexpected<Core::Error> Refuse(ECoreError code, std::string path, std::string expected, std::string found)
{
    return Core::Fail(make_error_code(code), std::move(path), std::move(expected), std::move(found));
}

Core::Result<void> CheckID(const std::string& text, std::string path, bool bMayBeEmpty)
{
    if (text.empty() && !bMayBeEmpty)
    {
        return Refuse(ECoreError::MissingField, std::move(path), "an id", "nothing");
    }
    if (text.size() > MAXIMUM_ID_LENGTH)
    {
        return Refuse(
            ECoreError::InvalidIdentifier,
            std::move(path),
            fmt::format("at most {} bytes", MAXIMUM_ID_LENGTH),
            fmt::format("{} bytes", text.size()));
    }
    if (Core::HasControlCharacter(text))
    {
        return Refuse(
            ECoreError::InvalidIdentifier,
            std::move(path),
            "an id without control characters",
            Core::QuoteForError(text));
    }
    return {};
}

bool IsInside(const Core::Location& place, const std::string& stationID)
{
    const std::string dock = place.GetDockingPlace().GetText();
    return dock == stationID || dock.starts_with(stationID + '.');
}

bool IsSameWord(std::string_view one, std::string_view other)
{
    return std::ranges::equal(one, other, [](unsigned char left, unsigned char right) {
        return std::tolower(left) == std::tolower(right);
    });
}

std::string ListActions(const ActionTable& actions)
{
    std::string list = "one of ";
    for (const auto& [name, rule] : actions)
    {
        list += list.size() > std::string_view("one of ").size() ? ", " : "";
        list += name;
    }
    return list;
}

Core::Result<void> CheckIDs(const Plan& plan)
{
    if (Core::Result<void> checked = CheckID(plan.planID, "planId", false); !checked.has_value())
    {
        return checked;
    }
    if (Core::Result<void> checked = CheckID(plan.lotID, "lotId", true); !checked.has_value())
    {
        return checked;
    }
    if (plan.steps.empty() || plan.steps.size() > MAXIMUM_STEPS)
    {
        return Refuse(
            ECoreError::OutOfRange,
            "steps",
            fmt::format("1 to {} steps", MAXIMUM_STEPS),
            fmt::format("{}", plan.steps.size()));
    }
    std::set<std::string> jobIDs;
    for (std::size_t i = 0; i < plan.steps.size(); ++i)
    {
        const Step& step = plan.steps[i];
        if (step.stepNo < 1 || (i > 0 && plan.steps[i - 1].stepNo == step.stepNo))
        {
            return Refuse(
                ECoreError::OutOfRange,
                fmt::format("steps[{}].stepNo", i),
                "a number from 1 that is unique in the plan",
                fmt::format("{}", step.stepNo));
        }
        for (std::size_t job = 0; job < step.jobs.size(); ++job)
        {
            const std::string path = fmt::format("steps[{}].jobs[{}].jobId", i, job);
            if (Core::Result<void> checked = CheckID(step.jobs[job].jobID, path, false); !checked.has_value())
            {
                return checked;
            }
            if (!jobIDs.insert(step.jobs[job].jobID).second)
            {
                return Refuse(
                    ECoreError::InvalidIdentifier,
                    path,
                    "a jobId that is unique in the plan",
                    step.jobs[job].jobID);
            }
        }
    }
    return {};
}

} // namespace

void SortSteps(Plan& plan)
{
    std::ranges::stable_sort(plan.steps, {}, &Step::stepNo);
}

PlanAdmission::PlanAdmission(const EngineOptions& options, const SiteMap& site)
    : _options(options),
      _site(site),
      _catalog(site)
{
    _catalog.Add(options.places);
    for (const RobotOptions& robot : options.robots)
    {
        _catalog.Add(robot.ports);
        _catalog.Add(robot.childPorts);
    }
    FindClasses();
}

std::optional<std::size_t> PlanAdmission::FindDockOrNull(std::string_view stationID, std::string_view vehicleTypeID)
    const
{
    const SiteStation* stationOrNull = _site.FindStationOrNull(stationID);
    if (stationOrNull == nullptr)
    {
        return std::nullopt;
    }
    for (const std::string& nodeID : stationOrNull->nodeIDs)
    {
        const std::size_t node = *_site.FindNodeIndexOrNull(nodeID);
        if (_site.GetNodes()[node].FindRuleOrNull(vehicleTypeID) != nullptr)
        {
            return node;
        }
    }
    return std::nullopt;
}

void PlanAdmission::SpellActions(Plan& plan) const
{
    for (Step& step : plan.steps)
    {
        if (_options.actions.contains(step.action))
        {
            continue;
        }
        const auto found = std::ranges::find_if(_options.actions, [&step](const auto& action) {
            return IsSameWord(action.first, step.action);
        });
        if (found != _options.actions.end())
        {
            step.action = found->first;
        }
    }
}

Core::Result<ResolvedPlan> PlanAdmission::Resolve(const Plan& plan) const
{
    if (Core::Result<void> checked = CheckIDs(plan); !checked.has_value())
    {
        return tl::unexpected(std::move(checked.error()));
    }
    ResolvedPlan resolved;
    for (std::size_t i = 0; i < plan.steps.size(); ++i)
    {
        Core::Result<ResolvedStep> step = ResolveStep(plan.steps[i], fmt::format("steps[{}]", i));
        if (!step.has_value())
        {
            return tl::unexpected(std::move(step.error()));
        }
        resolved.steps.push_back(std::move(*step));
        const ERobotType first = resolved.steps.front().rule->robotType;
        if (resolved.steps.back().rule->robotType != first)
        {
            return Refuse(
                ECoreError::UnknownWord,
                fmt::format("steps[{}].action", i),
                fmt::format("an action of {} robots, as in the previous steps", GetText(first)),
                plan.steps[i].action);
        }
    }
    if (Core::Result<void> checked = CheckPorts(plan, resolved);
        !checked.has_value() && !_options.dispatch.bLoadsIntoTakenPorts)
    {
        return tl::unexpected(std::move(checked.error()));
    }
    if (Core::Result<void> found = FindCandidates(plan, resolved); !found.has_value())
    {
        return tl::unexpected(std::move(found.error()));
    }
    return resolved;
}

Core::Result<ResolvedStep> PlanAdmission::ResolveStep(const Step& step, const std::string& path) const
{
    const auto action = _options.actions.find(step.action);
    if (action == _options.actions.end())
    {
        return Refuse(ECoreError::UnknownWord, path + ".action", ListActions(_options.actions), step.action);
    }
    ResolvedStep resolved;
    resolved.rule = &action->second;
    const Core::Result<Core::Location> position = ResolvePosition(step.position, path + ".position");
    if (!position.has_value())
    {
        return tl::unexpected(position.error());
    }
    resolved.stationID = position->GetText();
    if (step.jobs.size() > MAXIMUM_JOBS || (step.jobs.empty() && resolved.rule->bJobsRequired))
    {
        return Refuse(
            ECoreError::OutOfRange,
            path + ".jobs",
            fmt::format("1 to {} jobs for {}", MAXIMUM_JOBS, step.action),
            fmt::format("{}", step.jobs.size()));
    }
    for (std::size_t i = 0; i < step.carrierIDs.size(); ++i)
    {
        if (Core::Result<void> checked = CheckID(step.carrierIDs[i], fmt::format("{}.carrierIds[{}]", path, i), true);
            !checked.has_value())
        {
            return tl::unexpected(std::move(checked.error()));
        }
    }
    for (std::size_t i = 0; i < step.jobs.size(); ++i)
    {
        const std::string jobPath = fmt::format("{}.jobs[{}]", path, i);
        auto from = ResolvePlace(step.jobs[i].from, resolved.rule->from, *position, jobPath + ".from");
        auto to = ResolvePlace(step.jobs[i].to, resolved.rule->to, *position, jobPath + ".to");
        if (!from.has_value() || !to.has_value())
        {
            return tl::unexpected(std::move(from.has_value() ? to.error() : from.error()));
        }
        resolved.jobs.push_back({std::move(*from), std::move(*to)});
    }
    return resolved;
}

Core::Result<Core::Location> PlanAdmission::ResolvePosition(const std::string& text, const std::string& path) const
{
    Core::Result<Core::Location> location = Core::Location::Parse(text);
    if (!location.has_value())
    {
        location.error().path = path;
        return location;
    }
    const bool bShortForm = location->GetSegments().front().kind == Core::ESegmentKind::Set;
    if (bShortForm)
    {
        if (std::optional<Core::Location> complete = _catalog.CompleteSetOrNull(*location))
        {
            location = std::move(*complete);
        }
    }
    Core::Location dock = location->GetDockingPlace();
    if (_site.FindStationOrNull(dock.GetText()) == nullptr)
    {
        return Refuse(ECoreError::InvalidLocation, path, "a station of this site", text);
    }
    return dock;
}

Core::Result<std::optional<Core::Location>> PlanAdmission::ResolvePlace(
    const std::optional<std::string>& text,
    EPlaceRule rule,
    const Core::Location& position,
    const std::string& path) const
{
    if (rule == EPlaceRule::None)
    {
        return std::nullopt;
    }
    if (!text.has_value() || text->empty())
    {
        return Refuse(ECoreError::MissingField, path, std::string(DescribePlaceRule(rule)), "nothing");
    }
    const Core::Result<Core::Location> location = Core::Location::Parse(*text);
    if (!location.has_value())
    {
        Core::Error error = location.error();
        error.path = path;
        return tl::unexpected(std::move(error));
    }
    Core::Location place = location->WithAreaOf(position);
    if (Core::Result<void> checked = CheckPlace(place, rule, path); !checked.has_value())
    {
        return tl::unexpected(std::move(checked.error()));
    }
    if (!place.IsRobotPort() && !IsWithinReach(place, position))
    {
        return Refuse(
            ECoreError::InvalidLocation,
            path,
            fmt::format(
                "a place within reach of {0}, the step's position (stations.\"{0}\".reach does not list {1})",
                position.GetText(),
                place.GetDockingPlace().GetText()),
            place.GetOriginalText());
    }
    return std::optional(std::move(place));
}

/// Section 6.4: the robot does not move during the jobs of a step. The map does not state which stations are within reach; the
/// configuration does.
bool PlanAdmission::IsWithinReach(const Core::Location& place, const Core::Location& position) const
{
    if (IsInside(place, position.GetText()))
    {
        return true;
    }
    const auto reach = _options.reach.find(position.GetText());
    return reach != _options.reach.end() && std::ranges::any_of(reach->second, [&place](const std::string& stationID) {
               return IsInside(place, stationID);
           });
}

/// A port has one carrier. What it has before the plan is not known here.
Core::Result<void> PlanAdmission::CheckPorts(const Plan& plan, const ResolvedPlan& resolved)
{
    std::map<std::string, bool> filled; // by port, whichever the robot is
    for (std::size_t i = 0; i < resolved.steps.size(); ++i)
    {
        const ResolvedStep& step = resolved.steps[i];
        for (std::size_t end = 0; end < 2 * step.jobs.size(); ++end)
        {
            const std::size_t job = end / 2;
            const bool bFills = end % 2 == 1; // the from of a job, then its to
            const std::optional<Core::Location>& port = bFills ? step.jobs[job].to : step.jobs[job].from;
            if (!IsPortChanged(step.rule->effect, bFills) || !port.has_value() || !port->IsRobotPort())
            {
                continue;
            }
            const auto [known, bFirst] = filled.emplace(port->GetText().substr(port->GetText().find('.')), bFills);
            if (!bFirst && std::exchange(known->second, bFills) == bFills)
            {
                return Refuse(
                    ECoreError::InvalidLocation,
                    fmt::format("steps[{}].jobs[{}].{}", i, job, bFills ? "to" : "from"),
                    bFills ? "a port that no earlier job loads" : "a port that no earlier job unloads",
                    fmt::format("{} for job {}", port->GetOriginalText(), plan.steps[i].jobs[job].jobID));
            }
        }
    }
    return {};
}

Core::Result<void> PlanAdmission::CheckPlace(const Core::Location& place, EPlaceRule rule, const std::string& path)
    const
{
    if (!IsPlaceAllowed(place, rule))
    {
        return Refuse(ECoreError::InvalidLocation, path, std::string(DescribePlaceRule(rule)), place.GetOriginalText());
    }
    if (!place.IsRobotPort())
    {
        return _catalog.Contains(place)
            ? Core::Result<void>()
            : Refuse(ECoreError::InvalidLocation, path, "a place of this site", place.GetOriginalText());
    }
    const Core::RobotID& named = *place.GetRobotOrNull();
    if (!named.IsAlias() && !_robots.contains(named.GetText()))
    {
        return Refuse(ECoreError::InvalidLocation, path, "a robot of this site", named.GetText());
    }
    return {};
}

} // namespace ACS::Planning
