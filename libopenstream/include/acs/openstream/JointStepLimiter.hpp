#pragma once

#include <acs/core/Api.hpp>

#include <cstddef>
#include <span>
#include <vector>

namespace ACS::OpenStream
{

/// Limits the step of each joint between consecutive streamed points. The owner of a trajectory passes each point to Limit
/// before sending it in a CONTROL. Limits the step, not the speed: the speed is step by interval, so the limits apply to one
/// interval. A limited point lags behind the requested one until later points let it catch up; no additional points are
/// sent. Not a substitute for the robot's own limits.
class ACS_API JointStepLimiter
{
    std::vector<double> _largestSteps;
    std::vector<double> _last;
    bool _bLimited = false;

public:
    /// The largest step of each joint, in the unit of the points; 0 and NaN lock the joint, infinity does not limit it.
    /// Further joints are not limited.
    explicit JointStepLimiter(std::vector<double> largestSteps);

    /// Sets the current position. Call before the first point and after each stop or reconnect, when the position differs
    /// from the last point. A limited joint whose position is not finite stays so until the next call.
    void Begin(std::span<const double> position);

    /// The point to send, with the same number of joints; valid until the next call. A joint that is not finite keeps its
    /// last value, or 0; a joint that a shorter point leaves out keeps its last value for later points. Without Begin the
    /// first point is not limited.
    [[nodiscard]] std::span<const double> Limit(std::span<const double> wanted);

    /// Whether the last point was limited.
    [[nodiscard]] bool WasLimited() const noexcept;
};

} // namespace ACS::OpenStream
