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

    std::optional<StartJob> _job;
    EState _state = EState::Commanded;
    bool _bOverdue = false;
    std::string
        _abandonedID; ///< The last job if an operator has abandoned it and the robot may still have it; or empty.

public:
    void Begin(StartJob job);
    /// The job's plan has ended, and the job is to be cancelled. The robot gets no work until it has reported the end of the job.
    void MarkOverdue();
    void BeginRecovery();
    /// The robot has reported the outcome. False: it was not asked.
    [[nodiscard]] bool TryEndRecovery();
    void MarkUnresolved();
    /// By an operator's decision.
    void Resolve();
    /// By an operator's decision. The robot has not reported its end and must not continue it, also after its release.
    void Abandon();
    void Release();
    /// After a restart: the job was abandoned before.
    void RestoreAbandoned(std::string jobID);
    /// The job to cancel at a robot that is back: it may have missed the command. An abandoned job is returned once.
    [[nodiscard]] std::optional<std::string> TakeCancelOrNull();

    /// Null where no job is open.
    [[nodiscard]] const StartJob* GetOrNull() const noexcept;
    /// Empty: the robot has no abandoned job, or was commanded again to cancel it.
    [[nodiscard]] const std::string& GetAbandonedID() const noexcept;
    [[nodiscard]] bool IsRecovering() const noexcept;
    [[nodiscard]] bool IsUnresolved() const noexcept;
    [[nodiscard]] bool IsOverdue() const noexcept;
    [[nodiscard]] bool IsOverdue(std::string_view jobID) const noexcept;
};

} // namespace ACS::Planning
