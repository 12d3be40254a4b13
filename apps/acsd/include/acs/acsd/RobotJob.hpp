#pragma once

#include <acs/core/Api.hpp>
#include <acs/plan/IRobotAdapter.hpp>
#include <acs/plan/RobotCommand.hpp>
#include <acs/plan/RobotEvent.hpp>

#include <optional>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// The job of a robot that stores the commandID of each job and can be asked for it: keeps the job until its outcome is known, and raises
/// the events of the job. Pure; an adapter owns one for its robot. Each job is executed once if the adapter
/// - sends the job on StartJob, and asks for it on RecoverJob and after each connect;
/// - passes each answer of the robot on. One about another commandID than that of the job has no effect.
class ACS_API RobotJob final
{
    std::optional<Planning::StartJob> _job;
    bool _bStarted = false; ///< Since it was commanded, or since the restart of acsd.

public:
    /// Keeps the job of StartJob and RecoverJob; other commands have no effect.
    void Handle(const Planning::RobotCommand& command);

    /// The job whose outcome is not known; nullptr without one.
    [[nodiscard]] const Planning::StartJob* GetJobOrNull() const noexcept;

    /// The robot executes the job: JobStarted, once.
    void OnRunning(std::string_view commandID, Planning::AdapterActions& out);
    /// The robot has executed the job: JobFinished.
    void OnDone(std::string_view commandID, Planning::AdapterActions& out);

    /// The robot has moved nothing for the job, and will not: JobUnknown, or JobInterrupted with the reason if it had begun
    /// the job. The engine commands such a job again: pass only the answer to the last question, because that of an earlier one would
    /// end the new command.
    void OnNotExecuted(std::string_view commandID, const std::string& reason, Planning::AdapterActions& out);

    /// The robot refuses the job: JobRejected.
    void OnRejected(std::string_view commandID, const std::string& reason, Planning::AdapterActions& out);

    /// The robot has ended the job with a fault and will not continue it: JobFailed.
    void OnFailed(std::string_view commandID, const std::string& reason, Planning::AdapterActions& out);

private:
    [[nodiscard]] bool IsCurrent(std::string_view commandID) const noexcept;
    void End(const Planning::RobotEvent& event, Planning::AdapterActions& out);
};

} // namespace ACS::Acsd
