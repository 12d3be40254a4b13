#include "TraceText.hpp"

#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <variant>

namespace ACS::Simulation
{

std::string Describe(const Planning::Report& report)
{
    return std::visit(
        Core::Overloaded{
            [](const Planning::PlanReport& typed) {
                return fmt::format("plan {} {} {}", typed.planID, GetText(typed.state), typed.message);
            },
            [](const Planning::StepReport& typed) {
                return fmt::format("step {} of {} {}", typed.stepNo, typed.planID, GetText(typed.state));
            },
            [](const Planning::JobReport& typed) {
                return fmt::format("job {} of {} {}", typed.jobID, typed.planID, GetText(typed.state));
            },
            [](const Planning::ErrorReport& typed) {
                return fmt::format(
                    "alarm {} of {} {}",
                    typed.alarm.errorCode,
                    typed.alarm.robotID,
                    typed.bSet ? "set" : "cleared");
            },
            [](const Planning::ControlResultReport& typed) {
                return fmt::format(
                    "{} of {} {}: {}",
                    GetText(typed.control),
                    typed.planID,
                    typed.bSucceeded ? "succeeded" : "failed",
                    typed.message);
            }},
        report);
}

std::string Describe(const Planning::RobotCommand& command)
{
    return std::visit(
        Core::Overloaded{
            [](const Planning::Drive& typed) {
                std::string nodes;
                for (const Planning::RouteNode& node : typed.route.nodes)
                {
                    nodes += nodes.empty() ? node.nodeID : " " + node.nodeID;
                }
                return fmt::format("Drive {} ({}), {} released", typed.driveID, nodes, typed.releasedCount);
            },
            [](const Planning::ExtendDrive& typed) {
                return fmt::format("ExtendDrive {}, {} released", typed.driveID, typed.releasedCount);
            },
            [](const Planning::CancelDrive& typed) { return fmt::format("CancelDrive {}", typed.driveID); },
            [](const Planning::StartJob& typed) { return fmt::format("StartJob {} of {}", typed.jobID, typed.planID); },
            [](const Planning::RecoverJob& typed) {
                return fmt::format("RecoverJob {} of {}", typed.job.jobID, typed.job.planID);
            },
            [](const Planning::CancelJob& typed) { return fmt::format("CancelJob {}", typed.jobID); },
            [](const Planning::Pause&) { return std::string("Pause"); },
            [](const Planning::Resume&) { return std::string("Resume"); },
            [](const auto&) {
                return std::string("other command");
            }},
        command);
}

std::string Describe(const Planning::RobotEvent& event)
{
    return std::visit(
        Core::Overloaded{
            [](const Planning::LinkChanged& typed) {
                return std::string(typed.bOnline ? "is connected" : "is disconnected");
            },
            [](const Planning::StateChanged& typed) {
                return fmt::format(
                    "on {}{}{}{}{}{}",
                    typed.lastNodeID,
                    typed.bDriving ? " drives" : "",
                    typed.bPaused ? " paused" : "",
                    typed.bOccupied ? " occupied" : "",
                    typed.bSafetyStop ? " safety stop" : "",
                    typed.bAutomatic ? "" : " manual mode");
            },
            [](const Planning::NodePassed& typed) { return fmt::format("passed {}", typed.nodeID); },
            [](const Planning::Arrived&) { return std::string("arrived"); },
            [](const Planning::DriveRejected& typed) { return fmt::format("rejected: {}", typed.reason); },
            [](const Planning::DriveCancelled& typed) { return fmt::format("cancelled on {}", typed.nodeID); },
            [](const Planning::JobStarted& typed) { return fmt::format("job {} started", typed.jobID); },
            [](const Planning::JobFinished& typed) { return fmt::format("job {} finished", typed.jobID); },
            [](const Planning::JobFailed& typed) {
                return fmt::format("job {} failed: {}", typed.jobID, typed.reason);
            },
            [](const Planning::JobRejected& typed) {
                return fmt::format("job {} rejected: {}", typed.jobID, typed.reason);
            },
            [](const Planning::JobInterrupted& typed) {
                return fmt::format("job {} interrupted: {}", typed.jobID, typed.reason);
            },
            [](const Planning::JobUnknown& typed) { return fmt::format("job {} is unknown", typed.jobID); },
            [](const Planning::JobUnresolved& typed) {
                return fmt::format("outcome of job {} unknown: {}", typed.jobID, typed.reason);
            },
            [](const Planning::JobCheckChanged&) { return std::string("checks jobs again"); },
            [](const Planning::CompatibilityChanged& typed) {
                return typed.incompatibility.empty() ? std::string("compatible")
                                                     : "incompatible: " + typed.incompatibility;
            },
            [](const auto&) {
                return std::string("other event");
            }},
        event);
}

} // namespace ACS::Simulation
