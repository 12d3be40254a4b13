#pragma once

#include <acs/plan/RobotCommand.hpp>

#include <cstdint>
#include <optional>
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

public:
    void Begin(StartJob job);
    /// The job's plan has ended. The robot gets no work until it has reported the end of the job.
    void MarkOverdue();
    void BeginRecovery();
    /// The robot has reported the outcome. False: it was not asked.
    [[nodiscard]] bool TryEndRecovery();
    void MarkUnresolved();
    /// By an operator's decision.
    void Resolve();
    void Release();

    /// Null where no job is open.
    [[nodiscard]] const StartJob* GetOrNull() const noexcept;
    [[nodiscard]] bool IsRecovering() const noexcept;
    [[nodiscard]] bool IsUnresolved() const noexcept;
    [[nodiscard]] bool IsOverdue() const noexcept;
    [[nodiscard]] bool IsOverdue(std::string_view jobID) const noexcept;
};

} // namespace ACS::Planning
