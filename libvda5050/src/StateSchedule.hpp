#pragma once

#include <acs/vda5050/VehicleAction.hpp>
#include <acs/vda5050/VehicleOptions.hpp>

#include <cstdint>
#include <optional>

namespace ACS::VDA5050
{

/// When a vehicle publishes its state: after a change, but not before the minimum interval, and after the maximum interval.
class StateSchedule
{
    enum class EDue : std::uint8_t
    {
        No,
        Yes,
        WhenTimerEnds, ///< The timer of the minimum interval runs.
    };

    const VehicleOptions& _options;
    EDue _due = EDue::No;
    bool _bLinkUp = false;
    std::optional<Core::SteadyTime> _lastStateTime;

public:
    /// The options must outlive the schedule.
    explicit StateSchedule(const VehicleOptions& options);

    void OnLinkUp();
    void OnLinkDown(VehicleActions& out);
    void OnMinimumTimer();
    /// Something has changed that the next state must show soon.
    void Request();
    /// Whether to publish a state now. If it is too early, the timer of the minimum interval runs.
    [[nodiscard]] bool ShouldPublish(Core::Now now, VehicleActions& out);
    void OnPublished(Core::Now now, VehicleActions& out);

    [[nodiscard]] bool IsLinkUp() const noexcept;
};

} // namespace ACS::VDA5050
