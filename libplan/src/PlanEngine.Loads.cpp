#include "PlanEngine.Impl.hpp"
#include <acs/core/ControlCharacter.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace ACS::Planning
{

namespace
{

/// An id that an operator could not give a carrier either is none.
bool HasID(const PortLoad& load)
{
    return !load.carrierID.empty() && load.carrierID.size() <= MAXIMUM_ID_LENGTH
        && !Core::HasControlCharacter(load.carrierID) && load.carrierID != UNKNOWN_CARRIER;
}

/// A robot that knows no ids contradicts none, and nothing contradicts an unknown carrier but an empty port.
bool IsAgreed(const std::optional<std::string>& expected, const PortLoad& load)
{
    if (!load.bLoaded || !expected.has_value())
    {
        return load.bLoaded == expected.has_value();
    }
    return !HasID(load) || *expected == UNKNOWN_CARRIER || *expected == load.carrierID;
}

std::optional<std::string> MergeOrNull(const std::optional<std::string>& known, const PortLoad& load)
{
    if (!load.bLoaded)
    {
        return std::nullopt;
    }
    return HasID(load) ? load.carrierID : known.value_or(std::string(UNKNOWN_CARRIER));
}

} // namespace

/// The robot's sensors replace the record. Not at the ports of a job that has not ended, or whose outcome nobody knows: what
/// is there meanwhile says nothing yet.
void PlanEngine::Impl::CompareLoads(Robot& robot)
{
    if (!robot.state->loads.has_value() || robot.bDoubtful)
    {
        return;
    }
    const std::vector<PortUse> uses = robot.job.has_value() ? ListPortUses(robot, *robot.job) : std::vector<PortUse>();
    const std::vector<std::optional<std::string>> recorded = robot.carriers;
    const std::map<std::size_t, std::optional<std::string>> disputed = robot.disputedPorts;
    for (const PortLoad& load : *robot.state->loads)
    {
        const std::optional<std::size_t> port = FindNamedPortOrNull(robot, load.port);
        if (port.has_value() && std::ranges::count(uses, *port, &PortUse::port) == 0)
        {
            CompareLoad(robot, *port, load);
        }
    }
    if (robot.carriers != recorded)
    {
        _changes.emplace_back(CarriersChanged{GetRobotID(robot), robot.carriers});
        _bDispatchNeeded = true;
    }
    if (robot.carriers != recorded || robot.disputedPorts != disputed)
    {
        UpdateLoadAlarm(robot);
    }
}

void PlanEngine::Impl::CompareLoad(Robot& robot, std::size_t port, const PortLoad& load)
{
    std::optional<std::string>& record = robot.carriers[port];
    const auto disputed = robot.disputedPorts.find(port);
    if (!IsAgreed(record, load) && disputed != robot.disputedPorts.end() && IsAgreed(disputed->second, load))
    {
        record = MergeOrNull(disputed->second, load); // what was expected there is back
        robot.disputedPorts.erase(disputed);
        return;
    }
    if (!IsAgreed(record, load))
    {
        robot.disputedPorts.try_emplace(port, record);
    }
    record = MergeOrNull(record, load);
}

/// Set until each port shows again what was expected there, a job has moved its carrier, or an operator has looked.
void PlanEngine::Impl::UpdateLoadAlarm(const Robot& robot)
{
    Alarm alarm;
    alarm.robotID = GetRobotID(robot);
    alarm.errorCode = ALARM_LOADS;
    alarm.level = EAlarmLevel::Light;
    std::string differences;
    for (const auto& [port, expected] : robot.disputedPorts)
    {
        differences += fmt::format(
            "{}{}: expected {}, shown {}",
            differences.empty() ? "" : "; ",
            robot.options->ports[port].GetText(),
            expected.value_or("no carrier"),
            robot.carriers[port].value_or("no carrier"));
    }
    alarm.message = fmt::format(
        "Reported loads differ from the record: {}. The record follows the robot. Check the port, then correct the record "
        "or clear the alarm.",
        differences);
    const auto known = std::ranges::find_if(_alarms, [&alarm](const Alarm& other) { return other.IsSameAs(alarm); });
    if (known != _alarms.end() && (robot.disputedPorts.empty() || known->message != alarm.message))
    {
        ClearAlarm(alarm);
    }
    if (!robot.disputedPorts.empty())
    {
        RaiseAlarm(std::move(alarm));
    }
}

} // namespace ACS::Planning
