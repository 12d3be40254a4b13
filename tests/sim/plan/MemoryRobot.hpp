#pragma once

#include "ChanceModel.hpp"
#include "RobotMessages.hpp"
#include "TimerBank.hpp"
#include "Trace.hpp"
#include "WorkChecker.hpp"

#include <functional>
#include <optional>
#include <string>

namespace ACS::Simulation
{

/// A robot in memory, which continues when acsd crashes: drives along released nodes, does jobs, pauses and stops, and
/// remembers its commands.
class MemoryRobot final
{
public:
    using Listener = std::function<void(const RobotSnapshot& snapshot)>;

private:
    enum class ETimer : std::uint8_t
    {
        Move,
        Job,
    };

    /// The behaviour of this one.
    struct Nature
    {
        bool bStopsOnEdges = false;     ///< A pause stops it between two nodes.
        bool bFinishesJobs = false;     ///< A job that runs is not paused.
        bool bIgnoresJobCancel = false; ///< Like an arm, which never aborts its program.
        std::size_t slowness = 1;
    };

    Trace& _trace;
    WorkChecker& _workChecker;
    ChanceModel _chance;
    TimerBank<ETimer> _timers;
    std::string _robotID;
    Nature _nature;
    RobotSnapshot _snapshot;
    Listener _listener;

    std::optional<Planning::Drive> _drive;
    std::size_t _index = 0;    ///< Index of the node in the route.
    bool _bMoving = false;     ///< Between this node and the next one.
    bool _bMoveHalted = false; ///< The timer of the move is stopped.
    bool _bStopping = false;
    std::optional<Planning::StartJob> _job;
    bool _bJobHalted = false;
    bool _bPauseAsked = false;
    bool _bStopped = false;                 ///< Safety stop, manual mode or error: neither drives nor works.
    std::optional<std::string> _nextNodeID; ///< It lost its drive on the way to this node, and is between the two.

public:
    /// Per mille.
    std::size_t rejectChance = 0;
    std::size_t failChance = 0;

    MemoryRobot(
        Timeline& timeline,
        Trace& trace,
        WorkChecker& workChecker,
        const ChanceSeed& seed,
        std::string robotID,
        std::string nodeID);

    /// Notified of every change.
    void SetListener(Listener listener);
    void Receive(const RobotMessage& message);

    /// Begins a random emergency stop, manual mode or error for a while.
    void Disturb();
    void Forget();
    void Recover();

    [[nodiscard]] const RobotSnapshot& GetSnapshot() const noexcept;
    [[nodiscard]] bool IsDisturbed() const noexcept;

private:
    void BeginDrive(const Planning::Drive& drive);
    void Extend(const Planning::ExtendDrive& extension);
    void CancelDrive(const Planning::CancelDrive& cancel);
    void BeginJob(const Planning::StartJob& job);
    void CancelJob(const std::string& commandID);
    void SetPause(const PauseRequest& wish);
    void GoOn();
    void OnMoveTimer();
    void OnJobTimer();
    void FinishJob();
    void EndDrive(EDriveState state);
    void LoseDrive();
    void ShowBetween();
    [[nodiscard]] bool CanBegin(const Planning::Route& route) const;
    void EndJob(EJobState state, const std::string& reason);
    void Unhalt();
    void ShowPlace();
    void Show();
    [[nodiscard]] bool IsHalted() const noexcept;
    [[nodiscard]] const std::string& GetNodeID() const noexcept;
};

} // namespace ACS::Simulation
