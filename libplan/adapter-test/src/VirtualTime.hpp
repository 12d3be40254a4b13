#pragma once

#include <acs/adapter_test/IVirtualTime.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>

namespace ACS::AdapterTest
{

/// The tasks of a scenario, by time and then by the order in which they were posted. Starts at 2025-07-02T12:00:00Z.
class VirtualTime final : public IVirtualTime
{
public:
    using Ticket = std::pair<Core::SteadyTime, std::uint64_t>;

private:
    static constexpr std::chrono::seconds START_WALL{1'751'457'600};
    static constexpr std::chrono::seconds START_STEADY{1'000};
    /// Tasks without any progress of time: more than a robot needs for one message.
    static constexpr std::size_t MAXIMUM_AT_ONCE = 10'000;
    static constexpr std::size_t MAXIMUM_STEPS = 2'000'000;

    Core::Now _now{Core::SteadyTime(START_STEADY), Core::WallTime(START_WALL)};
    std::map<Ticket, Task> _tasks;
    std::uint64_t _lastOrder = 0;
    std::size_t _steps = 0;
    std::size_t _stepsAtOnce = 0;

public:
    [[nodiscard]] Core::Now GetNow() const override;
    void Post(Core::Duration delay, Task task) override;

    [[nodiscard]] Ticket PostTask(Core::Duration delay, Task task);
    /// A used ticket is ignored.
    void Withdraw(const Ticket& ticket);

    /// Runs the next task that is due until then. False: none is, and it is then.
    [[nodiscard]] bool TryStep(Core::SteadyTime until);

    /// Too many tasks were posted: no further one is run.
    [[nodiscard]] bool IsExhausted() const noexcept;
    /// Since the start.
    [[nodiscard]] Core::Duration GetAge() const;

private:
    void AdvanceTo(Core::SteadyTime time);
};

} // namespace ACS::AdapterTest
