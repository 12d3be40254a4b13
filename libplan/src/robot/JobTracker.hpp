#pragma once

#include <acs/plan/RobotCommand.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Planning
{

/// The job that a robot was commanded, from the command to the report of its end.
class JobTracker
{
    enum class EState : std::uint8_t
    {
        Commanded,
        Recovering, ///< After a restart: the robot was asked for the outcome.
        Unresolved, ///< The outcome is unknown: an operator decides.
    };

    enum class EEnd : std::uint8_t
    {
        Awaited,
        Reported, ///< The robot no longer has the job, whatever its outcome is.
        Decided,  ///< By an operator. The robot may still have the job.
    };

    enum class EInquiry : std::uint8_t
    {
        None,  ///< There was no restart since the command.
        Due,   ///< After a restart: the robot was not asked for the outcome yet.
        Asked, ///< It was.
    };

    struct Resolved
    {
        StartJob job;
        EInquiry inquiry = EInquiry::None;
    };

    std::optional<StartJob> _job;
    EState _state = EState::Commanded;
    EEnd _end = EEnd::Awaited;
    bool _bBegun = false; ///< The robot has reported the start since the command, or since a restart.
    bool _bOverdue = false;
    std::string
        _abandonedID; ///< The last job if an operator has abandoned it and the robot may still have it; or empty.
    /// A job that an operator has resolved, and whose program an arm may still run.
    std::optional<Resolved> _resolved;

public:
    void Begin(StartJob job);
    /// The robot has begun the job: no program of an earlier one runs.
    void MarkBegun(std::string_view jobID);
    /// The job's plan has ended, and the job is to be cancelled. The robot gets no work until it has reported the end of the job.
    void MarkOverdue();
    void BeginRecovery();
    /// The robot has reported the outcome. False: it was not asked.
    [[nodiscard]] bool TryEndRecovery();
    void MarkUnresolved();
    /// The robot has reported that it no longer has the job. True: the job was a resolved one.
    [[nodiscard]] bool TryEndResolved(std::string_view jobID);
    /// By an operator's decision.
    void Resolve();
    /// By an operator's decision. The robot has not reported its end and must not continue it, also after its release.
    void Abandon();
    /// A job with a progress token that an operator has decided before the robot has reported its end is kept as resolved.
    void Release();
    /// After a restart: the job was abandoned before.
    void RestoreAbandoned(std::string jobID);
    /// After a restart: the job was resolved before.
    void RestoreResolved(StartJob job);
    /// The robot is asked for the outcome of the resolved job.
    void BeginResolvedRecovery();
    /// The job to cancel at a robot that is back: it may have missed the command. An abandoned job is returned once.
    [[nodiscard]] std::optional<std::string> TakeCancelOrNull();

    /// Null where no job is open.
    [[nodiscard]] const StartJob* GetOrNull() const noexcept;
    /// Null: no arm can run the program of a resolved job.
    [[nodiscard]] const StartJob* GetResolvedOrNull() const noexcept;
    /// Empty: the robot has no abandoned job, or was commanded again to cancel it.
    [[nodiscard]] const std::string& GetAbandonedID() const noexcept;
    /// The robot has begun the job under its present command. After a restart false until it reports the start again.
    [[nodiscard]] bool HasBegun() const noexcept;
    [[nodiscard]] bool IsRecovering() const noexcept;
    /// After a restart the robot was asked for the outcome of this resolved job.
    [[nodiscard]] bool IsResolvedRecovering(std::string_view jobID) const noexcept;
    /// After a restart the robot is to be asked for the outcome of a resolved job, and has no other one to report.
    [[nodiscard]] bool IsResolvedRecoveryDue() const noexcept;
    [[nodiscard]] bool IsUnresolved() const noexcept;
    [[nodiscard]] bool IsOverdue() const noexcept;
    [[nodiscard]] bool IsOverdue(std::string_view jobID) const noexcept;

private:
    /// The open job.
    [[nodiscard]] bool IsOpen(std::string_view jobID) const noexcept;
};

} // namespace ACS::Planning
