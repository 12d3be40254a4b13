#pragma once

#include <acs/core/Now.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace ACS::Planning
{

/// How far a drive has come.
struct DriveProgress
{
    std::string driveID;
    bool bTaken = false;    ///< The robot has confirmed the drive.
    std::size_t passed = 0; ///< Index in the route of the last node passed.

    bool operator==(const DriveProgress&) const = default;
};

/// What becomes of the timer that limits the time without progress.
enum class EStallTimer : std::uint8_t
{
    Unchanged,
    Start,
    Cancel,
};

/// Watches whether a robot's drive makes progress. Progress is another node, another drive, or none.
class StallMonitor
{
public:
    struct Update
    {
        EStallTimer timer = EStallTimer::Unchanged;
        bool bStallEnded = false; ///< Its alarm is to be cleared.
    };

private:
    std::optional<DriveProgress> _progress;
    std::optional<std::size_t> _releasedCount; ///< nullopt: nothing is watched.
    Core::SteadyTime _since;                   ///< The last progress or extension.
    bool _bStalled = false;

public:
    /// progressOrNull: nullopt without a drive or a connection. releasedCountOrNull: released nodes; nullopt while no further
    /// node is expected. The time without progress restarts with each node and each extension.
    [[nodiscard]] Update OnProgress(
        std::optional<DriveProgress> progressOrNull,
        std::optional<std::size_t> releasedCountOrNull,
        Core::SteadyTime now);
    /// The timer has expired. False: nothing is watched.
    [[nodiscard]] bool TryStall();

    [[nodiscard]] bool IsStalled() const noexcept;
    [[nodiscard]] Core::Duration GetTimeWithoutProgress(Core::SteadyTime now) const noexcept;
    /// The limit while the robot drives along an edge: a long edge at low speed takes longer than the timeout.
    [[nodiscard]] static Core::Duration GetLimit(Core::Duration timeout, double edgeSeconds);
};

} // namespace ACS::Planning
