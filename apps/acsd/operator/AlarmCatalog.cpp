#include "operator/AlarmCatalog.hpp"

#include <algorithm>
#include <array>

namespace ACS::Acsd
{

namespace
{

constexpr std::string_view VEHICLE_PREFIX = "AGV-";

constexpr std::array CATALOG = std::to_array<AlarmDescription>({
    {"ACS-1001",
     "Plan ended by a restart",
     "The site or the robots were changed while acsd was stopped, and the plan no longer fits them.",
     "Check the robot and its carriers, and correct the record with `acsctl carriers ROBOT`. Then send a new plan, and run "
     "`acsctl clear ROBOT ACS-1001`."},
    {"ACS-1002",
     "Robot disconnected",
     "The robot or its arm is not connected, or it has sent no state for `robot.offline_after`.",
     "Check power, network and broker; `acsctl robot ROBOT` shows the topic and the last message. If the robot has left the "
     "floor, run `acsctl maintenance ROBOT on`."},
    {"ACS-1003",
     "Robot position invalid",
     "The robot reports no node, a node that is not on the map, a node that another robot has reserved, or a node off its route.",
     "Move the robot to a free node of the map; `acsctl robot ROBOT` shows its node. If the node in the message exists on the "
     "floor, correct the map."},
    {"ACS-1004",
     "Job contradicts the record",
     "A job loaded an occupied port, or unloaded an empty port or another carrier. Or the ports of the robot have changed in the "
     "configuration, and carriers are on record at ports that no longer exist.",
     "Check the ports of the robot. Then correct the record with `acsctl carriers ROBOT`."},
    {"ACS-1005",
     "Store failing",
     "The disk is full or failing, or the database was removed, moved or replaced.",
     "Free space, or put the file back: the message names the path and the reason. acsd retries every second and needs no "
     "restart."},
    {"ACS-1007",
     "Job cancelled after its start",
     "AbortPlan or a time limit ended a job that moves a carrier or a memory, or AbortPlan ended a plan with an unresolved job.",
     "Check whether the robot still has the carrier, and correct the record with `acsctl carriers ROBOT`. Then run "
     "`acsctl clear ROBOT ACS-1007`."},
    {"ACS-1008",
     "Job outcome unknown",
     "After a restart, a power loss of the robot, or contradicting loads, no report shows whether the job was done.",
     "Check the robot and the place. Then run `acsctl resolve PLAN JOB done`, `acsctl resolve PLAN JOB failed` or "
     "`acsctl resolve PLAN JOB again`."},
    {"ACS-1009",
     "Robot stalled",
     "For `drive.stall_timeout` the robot has passed no node, or has not confirmed its drive or its job.",
     "Check the robot and its lane to the node in the message. The plan continues when the robot moves; if it cannot, abort the "
     "plan."},
    {"ACS-1010",
     "Robot not charging",
     "The battery is low, and the robot is at its charger but does not report charging.",
     "Check the charger and its contact. acsd repeats the command every 10 s."},
    {"ACS-1011",
     "Reported loads different from the record",
     "A carrier was moved by hand, a sensor is wrong, or one carrier is reported at two ports.",
     "Check the ports. If the reported loads are right, run `acsctl clear ROBOT ACS-1011`; otherwise repair the sensor."},
    {"ACS-1012",
     "Robot unavailable",
     "The robot rejected or dropped `robot.max_rejections` commands in a row; the message has its last reason.",
     "Remove the reason; a robot off its route must be moved to a node of the map. Then run `acsctl clear ROBOT ACS-1012`."},
    {"ACS-1013",
     "Robot incompatible",
     "The factsheet of the vehicle does not allow what acsd has to send; the message names the member.",
     "Correct the factsheet, `robots.NAME.factsheet_file`, the map, or the actions of the robot."},
    {"ACS-1014",
     "Further errors",
     "The robot reports more errors than acsd sets alarms for.",
     "Check the robot; `acsctl robot ROBOT` lists its errors."},
    {"ACS-1015",
     "Robot waits without progress",
     "For `drive.wait_timeout` the robot has waited for a blocked place, for a tray, or for robots none of which drives or works.",
     "`acsctl why PLAN` shows for what it waits, and what stops the other robots. Remedy that first."},
    {"ACS-1020",
     "Outbox full",
     "Too many reports have no acknowledgement of the MCS. New plans are refused.",
     "Check the MCS and the link to it; `acsctl status` shows both. acsd accepts plans again when the MCS acknowledges reports."},
    {"ACS-1021",
     "Log of the store not merged",
     "Another program reads the database, so that its log grows until the disk is full.",
     "End the program that reads the database; `fuser -v` with the path of the message lists it. acsd needs no restart."},
    {"AGV-mapNotEnabled",
     "Map of the vehicle missing",
     "A map that the vehicle needs is not on it, not enabled, or has another version than `robots.NAME.maps`.",
     "Enable the map at the vehicle, or correct `robots.NAME.maps`."},
    {"ARM-countersMissing",
     "Program counters missing",
     "The samples of the controller have no words at `arm.monitor_start` and `arm.counter_…`.",
     "Check these keys and the relays of the controller. acsd retries every 5 s."},
    {"ARM-monitorRefused",
     "MONITOR refused",
     "The controller of the arm rejects `arm.monitor_url`; the message has its reason.",
     "Check `arm.monitor_…` and the version of the controller. acsd retries every 5 s."},
    {"ARM-motorOff",
     "Arm motor off",
     "The motor of the arm is off; the message has the reason of the controller.",
     "Release the emergency stop, close the safeguard, and switch the controller to remote mode. acsd requests motor on every "
     "5 s."},
    {"ARM-programHalted",
     "Arm program stopped before its end",
     "Emergency stop, mode switch or teach pendant stopped the program, or the controller refuses to resume it.",
     "Remove the cause, then resume the program at the controller. If it cannot continue, cancel it there: the job then fails."},
    {"AGV-*",
     "Error of the vehicle",
     "The vehicle lists this error in its state; the message has its description.",
     "See the manual of the vehicle; `acsctl robot ROBOT` lists all its errors. The alarm is cleared when the vehicle no longer "
     "lists the error."},
    {"*",
     "Other alarm",
     "This version of acsd does not know the code. The driver of the robot reports it, or another version of acsd has stored it.",
     "Read the message of the alarm, and check the robot with `acsctl robot ROBOT`. If the cause is removed and the alarm stays, "
     "run `acsctl clear ROBOT CODE`."},
});

constexpr const AlarmDescription& VEHICLE_ERROR = CATALOG[CATALOG.size() - 2];
constexpr const AlarmDescription& OTHER = CATALOG.back();

} // namespace

std::span<const AlarmDescription> GetAlarmCatalog() noexcept
{
    return CATALOG;
}

const AlarmDescription& DescribeAlarm(std::string_view errorCode) noexcept
{
    const auto* const found = std::ranges::find(CATALOG, errorCode, &AlarmDescription::errorCode);
    if (found != CATALOG.end())
    {
        return *found;
    }
    return errorCode.starts_with(VEHICLE_PREFIX) ? VEHICLE_ERROR : OTHER;
}

} // namespace ACS::Acsd
