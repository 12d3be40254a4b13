#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace ACS::OpenStream
{

/// Bounds how far each joint moves from one streamed point to the next, against the last point that was sent. For the owner
/// of a trajectory: each point goes through Limit before it goes into a CONTROL. Bounds the step, not the speed: the speed
/// is step by interval, so the limits belong to one interval. A point that is held back stays behind what was wanted until
/// later points let it catch up; nothing is sent besides. No substitute for the robot's own limits.
class JointStepLimiter
{
    std::vector<double> _largestSteps;
    std::vector<double> _last;
    bool _bLimited = false;

public:
    /// For each joint the largest step, in the unit of the points; 0 holds the joint, infinity leaves it free. Joints
    /// beyond these are free.
    explicit JointStepLimiter(std::vector<double> largestSteps);

    /// Where the arm is: before the first point, and again after each stop or reconnect, as the real position is then
    /// another than that of the last point.
    void Begin(std::span<const double> position);

    /// The point to send, of as many joints; valid until the next call. A joint that is no finite number stays where it is,
    /// at 0 where nothing is known of it. Before Begin the first point passes as it is, as far as it is finite.
    [[nodiscard]] std::span<const double> Limit(std::span<const double> wanted);

    /// Whether the last point differs from what was wanted.
    [[nodiscard]] bool WasLimited() const noexcept;
};

} // namespace ACS::OpenStream
