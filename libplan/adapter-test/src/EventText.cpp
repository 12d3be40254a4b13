#include "EventText.hpp"

#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <variant>

namespace ACS::AdapterTest
{

std::string DescribeEvent(const Planning::RobotEvent& event)
{
    return std::visit(
        Core::Overloaded{
            [](const Planning::LinkChanged& link) {
                return std::string(link.bOnline ? "LinkChanged to online" : "LinkChanged to offline");
            },
            [](const Planning::StateChanged& state) {
                return fmt::format("StateChanged at node '{}'", state.lastNodeID);
            },
            [](const Planning::NodePassed& passed) {
                return fmt::format("NodePassed of {} at node '{}'", passed.driveID, passed.nodeID);
            },
            [](const Planning::Arrived& arrived) { return "Arrived of " + arrived.driveID; },
            [](const Planning::DriveRejected& rejected) {
                return fmt::format("DriveRejected of {} ({})", rejected.driveID, rejected.reason);
            },
            [](const Planning::DriveCancelled& cancelled) {
                return fmt::format("DriveCancelled of {} at node '{}'", cancelled.driveID, cancelled.nodeID);
            },
            [](const Planning::JobStarted& job) { return "JobStarted of " + job.jobID; },
            [](const Planning::JobFinished& job) { return "JobFinished of " + job.jobID; },
            [](const Planning::JobFailed& job) { return fmt::format("JobFailed of {} ({})", job.jobID, job.reason); },
            [](const Planning::JobRejected& job) {
                return fmt::format("JobRejected of {} ({})", job.jobID, job.reason);
            },
            [](const Planning::JobInterrupted& job) {
                return fmt::format("JobInterrupted of {} ({})", job.jobID, job.reason);
            },
            [](const Planning::JobUnknown& job) { return "JobUnknown of " + job.jobID; },
            [](const Planning::JobUnresolved& job) {
                return fmt::format("JobUnresolved of {} ({})", job.jobID, job.reason);
            },
            [](const Planning::JobCheckChanged& /*check*/) { return std::string("JobCheckChanged"); },
            [](const Planning::CompatibilityChanged& compatibility) {
                return fmt::format("CompatibilityChanged ({})", compatibility.incompatibility);
            }},
        event);
}

} // namespace ACS::AdapterTest
