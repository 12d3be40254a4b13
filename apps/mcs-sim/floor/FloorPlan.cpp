#include "floor/FloorPlan.hpp"

#include <acs/core/Location.hpp>
#include <acs/core/Overloaded.hpp>
#include <acs/core/RobotID.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>
#include <variant>

namespace ACS::McsSim
{

namespace
{

constexpr std::string_view OPEN_SET_COVER = "OpenSetCover";
constexpr std::string_view CLOSE_SET_COVER = "CloseSetCover";
constexpr std::string_view START = "Start";
/// Of the carrier that --restock puts at a place from which the plan takes one without naming it.
constexpr std::string_view UNNAMED = "UNNAMED-";

/// Nullopt: the text is no location, and the ACS refuses the plan.
std::optional<Core::Location> ParseOrNull(const std::string& text, const std::string& position)
{
    const Core::Result<Core::Location> location = Core::Location::Parse(text);
    if (!location.has_value())
    {
        return std::nullopt;
    }
    const Core::Result<Core::Location> area = Core::Location::Parse(position);
    return area.has_value() ? location->WithAreaOf(*area) : *location;
}

/// Walks through a plan once and keeps what its robot carries.
class PlanWalk
{
    FloorPlan _result;
    std::map<std::string, std::string> _carriers; ///< On the robot's ports, by port.
    std::map<std::string, std::string> _origins;  ///< Where those carriers were when the plan began, by port.
    std::set<std::string> _seen;                  ///< Places whose first use is past.
    std::set<std::string> _claims;

public:
    void Visit(const Protocol::PlanStep& step)
    {
        const std::optional<Core::Location> position = ParseOrNull(step.position, step.position);
        if (!position.has_value())
        {
            return;
        }
        Claim(*position);
        for (std::size_t i = 0; i < step.jobs.size(); ++i)
        {
            Visit(step, i, *position);
        }
        const std::optional<Sim::WorldEvent> event = MakeSetEventOrNull(step.action, *position);
        if (step.jobs.empty() && event.has_value())
        {
            _result.moves.push_back({step.stepNo, {}, *event});
        }
    }

    [[nodiscard]] FloorPlan Finish()
    {
        _result.claims.assign(_claims.begin(), _claims.end());
        return std::move(_result);
    }

private:
    static std::optional<Sim::WorldEvent> MakeSetEventOrNull(std::string_view action, const Core::Location& position)
    {
        if (action == OPEN_SET_COVER || action == CLOSE_SET_COVER)
        {
            return Sim::CoverMoved{{}, position.GetDockingPlace().GetText(), action == CLOSE_SET_COVER};
        }
        return action == START
            ? std::optional<Sim::WorldEvent>(Sim::ButtonPushed{{}, position.GetDockingPlace().GetText()})
            : std::nullopt;
    }

    void Visit(const Protocol::PlanStep& step, std::size_t index, const Core::Location& position)
    {
        const Protocol::PlanJob& job = step.jobs[index];
        const std::optional<Sim::WorldEvent> event = MakeSetEventOrNull(step.action, position);
        if (event.has_value())
        {
            _result.moves.push_back({step.stepNo, job.jobID, *event});
            return;
        }
        const std::optional<Core::Location> from = ParseOrNull(job.from, step.position);
        const std::optional<Core::Location> to = ParseOrNull(job.to, step.position);
        if (!from.has_value() || !to.has_value())
        {
            return;
        }
        Claim(*from);
        Claim(*to);
        if (from->IsMemoryPort() && to->IsMemoryPort())
        {
            _result.moves.push_back({step.stepNo, job.jobID, Sim::MemoryMoved{{}, from->GetText(), to->GetText()}});
            UseMemory(*from, Sim::EMemory::Occupied);
            UseMemory(*to, Sim::EMemory::Empty);
            return;
        }
        const std::string named = index < step.carrierIDs.size() ? step.carrierIDs[index] : std::string();
        const std::string carrierID = Take(*from, named);
        _result.moves.push_back(
            {step.stepNo, job.jobID, Sim::CarrierMoved{{}, carrierID, from->GetText(), to->GetText()}});
        Put(*from, *to, carrierID);
    }

    void Claim(const Core::Location& location)
    {
        if (!location.IsRobotPort())
        {
            _claims.insert(location.GetDockingPlace().GetText());
        }
    }

    /// The carrier that leaves the place; empty: any.
    std::string Take(const Core::Location& from, const std::string& named)
    {
        if (from.IsRobotPort())
        {
            const auto carried = _carriers.find(from.GetText());
            return carried == _carriers.end() ? named : carried->second;
        }
        if (_seen.insert(from.GetText()).second)
        {
            const std::string placed = named.empty() ? std::string(UNNAMED) + from.GetText() : named;
            _result.carriers.push_back({placed, from.GetText()});
            _claims.insert(placed);
        }
        return named;
    }

    void Put(const Core::Location& from, const Core::Location& to, const std::string& carrierID)
    {
        const auto moved = _origins.find(from.GetText());
        const std::string origin = moved != _origins.end() ? moved->second
            : from.IsRobotPort()                           ? std::string()
                                                           : from.GetText();
        _carriers.erase(from.GetText());
        _origins.erase(from.GetText());
        _carriers[to.GetText()] = carrierID;
        _origins[to.GetText()] = origin;
        if (!to.IsRobotPort() && _seen.insert(to.GetText()).second)
        {
            _result.carriers.push_back({{}, to.GetText()});
        }
    }

    /// What the place must hold when it is used for the first time. A memory in a tray is where the tray is at the start.
    void UseMemory(const Core::Location& place, Sim::EMemory memory)
    {
        if (!_seen.insert(place.GetText()).second)
        {
            return;
        }
        const std::string& text = place.GetText();
        const std::size_t tail = text.rfind('.');
        const auto tray = _origins.find(text.substr(0, tail));
        if (tray != _origins.end() && !tray->second.empty())
        {
            _result.memories.push_back({tray->second + text.substr(tail), memory});
        }
        else if (!place.IsRobotPort())
        {
            _result.memories.push_back({text, memory});
        }
    }
};

std::string Resolve(const std::string& place, const Core::RobotID& robotID)
{
    const Core::Result<Core::Location> location = Core::Location::Parse(place);
    const Core::Result<Core::Location> resolved =
        location.has_value() ? location->WithRobot(robotID) : tl::make_unexpected(location.error());
    return resolved.has_value() ? resolved->GetText() : place;
}

} // namespace

FloorPlan MakeFloorPlan(const Protocol::ExecutionPlan& plan)
{
    std::vector<const Protocol::PlanStep*> steps;
    steps.reserve(plan.steps.size());
    for (const Protocol::PlanStep& step : plan.steps)
    {
        steps.push_back(&step);
    }
    std::stable_sort(steps.begin(), steps.end(), [](const auto* left, const auto* right) {
        return left->stepNo < right->stepNo;
    });
    PlanWalk walk;
    for (const Protocol::PlanStep* const step : steps)
    {
        walk.Visit(*step);
    }
    return walk.Finish();
}

Sim::WorldEvent WithRobot(Sim::WorldEvent event, const std::string& robotID)
{
    const Core::Result<Core::RobotID> robot = Core::RobotID::Parse(robotID);
    const auto resolve = [&robot](std::string& place) {
        place = robot.has_value() ? Resolve(place, *robot) : place;
    };
    std::visit(
        Core::Overloaded{
            [&](Sim::CarrierMoved& moved) {
                moved.robotID = robotID;
                resolve(moved.from);
                resolve(moved.to);
            },
            [&](Sim::MemoryMoved& moved) {
                moved.robotID = robotID;
                resolve(moved.from);
                resolve(moved.to);
            },
            [&](Sim::CoverMoved& moved) { moved.robotID = robotID; },
            [&](Sim::ButtonPushed& pushed) { pushed.robotID = robotID; },
            // No robot's move.
            [](auto& /*other*/) {
            }},
        event);
    return event;
}

bool IsSameMove(const Sim::WorldEvent& expected, const Sim::WorldEvent& actual)
{
    const auto* const wantedOrNull = std::get_if<Sim::CarrierMoved>(&expected);
    const auto* const foundOrNull = std::get_if<Sim::CarrierMoved>(&actual);
    if (wantedOrNull == nullptr || foundOrNull == nullptr || !wantedOrNull->carrierID.empty())
    {
        return expected == actual;
    }
    Sim::CarrierMoved named = *wantedOrNull;
    named.carrierID = foundOrNull->carrierID;
    return named == *foundOrNull;
}

bool IsMove(const Sim::WorldEvent& event)
{
    return std::holds_alternative<Sim::CarrierMoved>(event) || std::holds_alternative<Sim::MemoryMoved>(event)
        || std::holds_alternative<Sim::CoverMoved>(event) || std::holds_alternative<Sim::ButtonPushed>(event);
}

std::string Describe(const Sim::WorldEvent& event)
{
    return std::visit(
        Core::Overloaded{
            [](const Sim::CarrierMoved& moved) {
                const std::string& carrier = moved.carrierID.empty() ? "a carrier" : moved.carrierID;
                return fmt::format("{}: {} from {} to {}", moved.robotID, carrier, moved.from, moved.to);
            },
            [](const Sim::MemoryMoved& moved) {
                return fmt::format("{}: a memory from {} to {}", moved.robotID, moved.from, moved.to);
            },
            [](const Sim::CoverMoved& moved) {
                return fmt::format("{}: cover of {} {}", moved.robotID, moved.set, moved.bClosed ? "closed" : "opened");
            },
            [](const Sim::ButtonPushed& pushed) {
                return fmt::format("{}: start button of {} pushed", pushed.robotID, pushed.place);
            },
            [](const auto& /*other*/) {
                return std::string();
            }},
        event);
}

} // namespace ACS::McsSim
