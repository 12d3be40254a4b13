#include "engine/PlanEngine.Impl.hpp"
#include <acs/core/ControlCharacter.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

namespace ACS::Planning
{

namespace
{

/// The alarm is set or updated once in this time at most. It is cleared at once.
constexpr std::chrono::seconds LOAD_ALARM_INTERVAL{10};

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

/// At which ports other than its own the load's carrier is shown ("CR01.TP02, CR01.TP03"); empty: at none.
std::string ListOtherPorts(const std::vector<PortLoad>& loads, const PortLoad& load)
{
    std::string ports;
    for (const PortLoad& other : loads)
    {
        if (load.bLoaded && HasID(load) && other.bLoaded && other.port != load.port
            && other.carrierID == load.carrierID)
        {
            ports += (ports.empty() ? "" : ", ") + other.port;
        }
    }
    return ports;
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

/// The robot's sensors replace the record. Not at the ports of a job that has not ended, or whose outcome is unknown: what
/// is there meanwhile says nothing yet.
void PlanEngine::Impl::CompareLoads(Robot& robot)
{
    if (!robot.state->loads.has_value() || robot.bDoubtful)
    {
        return;
    }
    const std::vector<PortUse> uses = robot.job.has_value() ? ListPortUses(robot, *robot.job) : std::vector<PortUse>();
    const std::vector<std::optional<std::string>> recorded = robot.carriers;
    const bool bWasDisputed = !robot.disputedPorts.empty();
    std::vector<std::size_t> ports;
    std::vector<PortLoad> loads;
    for (const PortLoad& load : *robot.state->loads)
    {
        const std::optional<std::size_t> port = FindNamedPortOrNull(robot, load.port);
        if (port.has_value() && std::ranges::count(uses, *port, &PortUse::port) == 0)
        {
            ports.push_back(*port);
            loads.push_back(load);
        }
    }
    for (std::size_t i = 0; i < loads.size(); ++i)
    {
        CompareLoad(robot, ports[i], loads[i], ListOtherPorts(loads, loads[i]));
    }
    if (robot.carriers != recorded)
    {
        _changes.emplace_back(CarriersChanged{GetRobotID(robot), robot.carriers});
        _bDispatchNeeded = true;
    }
    if (bWasDisputed || !robot.disputedPorts.empty())
    {
        UpdateLoadAlarm(robot);
    }
}

/// The other ports are those that show the same carrier. A carrier that is shown at two ports is evidence for neither: both are loaded, and their ids stay as on record.
void PlanEngine::Impl::CompareLoad(Robot& robot, std::size_t port, const PortLoad& load, const std::string& others)
{
    std::optional<std::string>& record = robot.carriers[port];
    auto disputed = robot.disputedPorts.find(port);
    if (others.empty() && disputed != robot.disputedPorts.end() && IsAgreed(disputed->second.expected, load)
        && (!IsAgreed(record, load) || record == disputed->second.expected))
    {
        record = MergeOrNull(disputed->second.expected, load); // what was expected there is back
        robot.disputedPorts.erase(disputed);
        return;
    }
    if (!others.empty() || !IsAgreed(record, load))
    {
        disputed = robot.disputedPorts.try_emplace(port, DisputedPort{record, {}}).first;
    }
    record = MergeOrNull(record, others.empty() ? load : PortLoad{load.port, true, {}});
    if (disputed != robot.disputedPorts.end())
    {
        disputed->second.shown =
            others.empty() ? record.value_or("no carrier") : fmt::format("{}, also at {}", load.carrierID, others);
    }
}

Alarm PlanEngine::Impl::MakeLoadAlarm(const Robot& robot) const
{
    std::string differences;
    for (const auto& [port, disputed] : robot.disputedPorts)
    {
        differences += fmt::format(
            "{}{}: expected {}, shown {}",
            differences.empty() ? "" : "; ",
            robot.options->ports[port].GetText(),
            disputed.expected.value_or("no carrier"),
            disputed.shown);
    }
    return MakeAlarm(
        GetRobotID(robot),
        ALARM_LOADS,
        EAlarmLevel::Light,
        fmt::format(
            "Reported loads differ from the record: {}. The record follows the robot, but a carrier shown at two ports "
            "changes no id. Check the ports, then correct the record or clear the alarm.",
            differences));
}

/// Set until each port shows again what was expected there, a job has moved its carrier, or an operator has checked it. A robot
/// whose loads change with each state must not flood the MCS: the first difference is reported at once, then the latest one
/// when the timer LoadAlarm has expired.
void PlanEngine::Impl::UpdateLoadAlarm(Robot& robot)
{
    Alarm alarm = MakeLoadAlarm(robot);
    if (robot.disputedPorts.empty())
    {
        ClearAlarm(alarm);
        return;
    }
    if (_alarms.Contains(alarm) || robot.bLoadAlarmLimited)
    {
        return;
    }
    robot.bLoadAlarmLimited = true;
    StartTimer(EEngineTimer::LoadAlarm, GetRobotID(robot), LOAD_ALARM_INTERVAL);
    ReportAlarms(_alarms.Update(std::move(alarm)));
}

void PlanEngine::Impl::OnLoadAlarmTimer(Robot& robot)
{
    robot.bLoadAlarmLimited = false;
    if (!robot.disputedPorts.empty())
    {
        UpdateLoadAlarm(robot);
    }
}

} // namespace ACS::Planning
