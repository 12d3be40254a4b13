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
    std::optional<std::string> _cancelID; ///< The job that the robot must not continue.

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
    void Release();
    /// A released job that the robot may still have: it has not reported its end.
    void CancelLater(std::string jobID);
    /// The job to cancel at a robot that is back: it may have missed the command. A released job is returned once.
    [[nodiscard]] std::optional<std::string> TakeCancelOrNull();

    /// Null where no job is open.
    [[nodiscard]] const StartJob* GetOrNull() const noexcept;
    [[nodiscard]] bool IsRecovering() const noexcept;
    [[nodiscard]] bool IsUnresolved() const noexcept;
    [[nodiscard]] bool IsOverdue() const noexcept;
    [[nodiscard]] bool IsOverdue(std::string_view jobID) const noexcept;
};

} // namespace ACS::Planning
