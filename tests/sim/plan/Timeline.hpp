#pragma once

#include <acs/core/Now.hpp>

#include <chrono>
#include <cstdint>
#include <functional>
#include <map>
#include <optional>
#include <utility>

namespace ACS::Simulation
{

/// The time of a run and all its future events in one order: by time, then by the order
/// in which they were posted. Starts at 2025-07-02T12:00:00Z.
class Timeline final : public Core::IClock
{
public:
    using Task = std::function<void()>;
    /// Identifies a waiting task.
    using Ticket = std::pair<Core::SteadyTime, std::uint64_t>;

private:
    static constexpr std::chrono::seconds START_WALL{1'751'457'600};
    static constexpr std::chrono::seconds START_STEADY{1'000};

    Core::Now _now{Core::SteadyTime(START_STEADY), Core::WallTime(START_WALL)};
    std::map<Ticket, Task> _tasks;
    std::uint64_t _lastOrder = 0;

public:
    [[nodiscard]] Core::Now GetNow() const override;

    /// Never runs within this call, also without a delay.
    Ticket Post(Core::Duration delay, Task task);

    /// A used ticket is ignored.
    void Withdraw(const Ticket& ticket);

    /// When the next task is due; nullopt: none is left.
    [[nodiscard]] std::optional<Core::SteadyTime> GetNextTimeOrNull() const;

    /// Runs the next task, at its time. False: none is left.
    [[nodiscard]] bool TryStep();

    /// Since the start of the run.
    [[nodiscard]] Core::Duration GetAge() const;
};

} // namespace ACS::Simulation
