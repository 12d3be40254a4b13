#pragma once

#include "api/ApiMessages.hpp"
#include "api/EApiError.hpp"
#include "arm/Arm.hpp"
#include "arm/MotorSwitch.hpp"
#include "arm/TrajectoryPoints.hpp"
#include "ConsoleProgram.hpp"
#include "controller/ControllerOptions.hpp"
#include "programs/FloorWork.hpp"
#include "programs/ProgramRunner.hpp"
#include "programs/RelayMemory.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::OpenStreamSim
{

inline constexpr std::size_t TOOLS = 32;

/// Where programs report their progress: 32-bit words in relay block m, at these bytes.
inline constexpr RelayBlock PROGRAM_BLOCK{ERelayBus::None, 0, ERelayArea::M};
inline constexpr std::size_t STARTED_BYTE = 400;  ///< Counts programs that began.
inline constexpr std::size_t FINISHED_BYTE = 404; ///< Counts programs that finished.
inline constexpr std::size_t FAILED_BYTE = 408;   ///< Counts programs that failed or were abandoned.
inline constexpr std::size_t LAST_BYTE = 412;     ///< The number of the program that ended last.
inline constexpr std::size_t ECHO_BYTE = 416;     ///< The job number that the program read when it began.

/// Alarms of the controller, with their numbers in rgen.
enum class EAlarm : std::int32_t
{
    None = -1,
    AxisTooFast = 159,    ///< E159: a trajectory was too fast for an axis.
    NotExecutable = 1554, ///< E01554: a trajectory's point came while no program waited in playback.
};
/// Decides whether a program fails: called when it has begun and when it is about to finish.
using ProgramJudge = std::function<bool(int number, bool bAtStart)>;
/// Decides whether a wrong value is stored: called when a client writes a relay.
using RelayJudge = std::function<bool()>;

/// Settings of operators and clients that affect only the answers.
struct ControllerSettings
{
    std::array<std::optional<Tool>, TOOLS> tools;
    int toolNo = 0;
    int coordinates = 1; ///< As crd_sys has it: 0 axis, 1 orthogonal, 2 user, 3 tool.
    int userCoordinates = 0;
    OperatingConditions conditions;
    bool bTrajectoryLog = false;
};

/// The simulated controller: motor, base task, relays, arm. Advance brings it to the present; the other methods act at that
/// time. Pure: time is a parameter.
class ControllerMachine
{
    /// Each of them keeps the motor off.
    struct SafetyStops
    {
        bool bPressed = false;       ///< The emergency stop, by a client.
        bool bHeldPressed = false;   ///< The emergency stop, by a fault.
        bool bSafeguardOpen = false; ///< The protective stop.
    };

    Core::Logger _logger;
    ControllerVersion _version;
    std::string _robotModel;
    double _timeScale;
    Core::SteadyTime _startedAt;
    Core::Duration _now{}; ///< Simulated, since _startedAt.
    bool _bRemote = true;
    SafetyStops _stops;
    MotorSwitch _motor;
    ProgramRunner _runner;
    ConsoleProgram _console;
    Arm _arm;
    EAlarm _alarm = EAlarm::None;
    RelayMemory _relays;
    ControllerSettings _settings;
    bool _bCursorMoved = false; ///< By a start or stop: no selection before SetCursor(1).
    ProgramJudge _shouldFail;
    RelayJudge _storesWrongValue;
    FloorWork _floorWork;

public:
    ControllerMachine(const ControllerOptions& options, Core::Now now, Core::Logger logger);

    void Advance(Core::Now now);

    /// The end of the running program, which has effects without a call of a client: Advance then.
    [[nodiscard]] std::optional<Core::SteadyTime> GetNextTimeOrNull() const;

    /// Each of these returns None on success.
    [[nodiscard]] EApiError SwitchMotorOn();
    [[nodiscard]] EApiError StartProgram();
    [[nodiscard]] EApiError SelectProgram(int number);

    /// Whether a selection is allowed: external ones (ext_sel 1) in remote mode, others outside of it, and none while a
    /// program plays.
    [[nodiscard]] EApiError CheckSelection(bool bExternal) const;
    /// set_cur_pc_idx of task 0: a selection may follow if the index is 1, the beginning of the program. The program is not
    /// rewound.
    [[nodiscard]] EApiError SetCursor(int index);
    /// Ends the current wait of the console's program.
    [[nodiscard]] EApiError ReleaseWait();

    /// Executes a single move in the base task; the program must not run. Abandons a program that was stopped before its end.
    [[nodiscard]] EApiError ExecuteMove(std::string_view statement);
    /// Runs the statements of AddStatement.
    [[nodiscard]] EApiError StartConsole();
    /// Returns Language if the simulator does not know the statement.
    [[nodiscard]] EApiError AddStatement(std::string_view statement);
    void ClearConsole();
    /// Ends the console's program and removes its statements. A selected program is not affected.
    void ExitConsole();

    /// joint_traject_init: stops the arm, empties the buffer and clears the alarm. From 70.06 on it has no effect while a
    /// trajectory is active; before 70.04 it ignores the agility.
    [[nodiscard]] EApiError InitTrajectory(const TrajectoryAgility& agility);
    /// joint_traject_insert_point; BadInput if its time is not after that of the previous point.
    [[nodiscard]] EApiError InsertPoint(const StreamedPoint& point);
    /// joint_traject_insert_points, all or nothing.
    [[nodiscard]] TrajectoryError InsertPoints(const TimedPoints& points);
    /// joint_traject_off: drops the remaining points.
    [[nodiscard]] EApiError FinishTrajectory();
    /// STOP control: empties the buffer and stops the arm, but leaves the alarm. A program or single move continues.
    void StopTrajectory();

    void SwitchMotorOff();
    void StopProgram();
    void ResetTasks();
    /// Clears the selection of a program. None may play.
    void ClearSelection();

    /// A client presses the emergency stop, which stops the program and switches the motor off, or releases it.
    void PressEmergencyStop(bool bPressed);
    /// Likewise for a fault. The emergency stop is released when neither presses it.
    void HoldEmergencyStop(bool bHeld);

    /// Action of the operator. Leaving remote mode stops the program.
    void TurnModeSwitch(bool bRemote);

    /// The safeguard opens, which stops the program and switches the motor off, or closes.
    void HoldProtectiveStop(bool bHeld);

    /// Initially no program fails.
    void SetProgramJudge(ProgramJudge shouldFail);
    /// Initially no wrong value is stored.
    void SetRelayJudge(RelayJudge storesWrongValue);

    /// set_relay_value; the name must lie inside its block.
    [[nodiscard]] Core::Result<void> WriteRelay(const RelayName& name, double value);

    [[nodiscard]] RelayMemory& GetRelays() noexcept;
    [[nodiscard]] ControllerSettings& GetSettings() noexcept;

    [[nodiscard]] const ControllerVersion& GetVersion() const noexcept;
    [[nodiscard]] const std::string& GetRobotModel() const noexcept;
    [[nodiscard]] bool IsRemote() const noexcept;
    [[nodiscard]] bool IsEmergencyStop() const noexcept;
    [[nodiscard]] bool IsPlaying() const noexcept;
    [[nodiscard]] EMotorState GetMotorState() const noexcept;
    [[nodiscard]] int GetProgram() const noexcept;

    [[nodiscard]] EAlarm GetAlarm() const noexcept;
    [[nodiscard]] const TrajectoryFollower& GetTrajectory() const noexcept;
    /// A trajectory moves the arm, is about to, or is being cleaned up.
    [[nodiscard]] bool IsTrajectoryActive() const;
    /// A trajectory's point would be accepted.
    [[nodiscard]] bool IsTrajectoryReady() const;

    /// 0 at the program's beginning, else 1 to 10 in step with its time.
    [[nodiscard]] int GetStep() const noexcept;

    /// Velocities in degrees per second of real time.
    [[nodiscard]] JointStates GetJointStates() const;

private:
    void HandleEvents(ProgramEvents events, Core::Duration elapsed);
    void BeginWork();
    /// Makes the program fail if it cannot do its work.
    void FinishWork(ProgramEvent& event);
    void Count(std::size_t byte);
    void HaltProgram();
    void AbandonProgram();
    void RaiseAlarm(EAlarm alarm);
    [[nodiscard]] ProgramProgress GetProgress() const;
    [[nodiscard]] EApiError CheckMotion() const;
    [[nodiscard]] EApiError AcceptTrajectory();
};

} // namespace ACS::OpenStreamSim
