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

/// Where a program tells what became of it: 32-bit words in relay block m, at these bytes.
inline constexpr RelayBlock PROGRAM_BLOCK{ERelayBus::None, 0, ERelayArea::M};
inline constexpr std::size_t STARTED_BYTE = 400;  ///< Counts programs that began.
inline constexpr std::size_t FINISHED_BYTE = 404; ///< Counts programs that ended well.
inline constexpr std::size_t FAILED_BYTE = 408;   ///< Counts programs that gave up.
inline constexpr std::size_t LAST_BYTE = 412;     ///< The number of the program that ended last.
inline constexpr std::size_t ECHO_BYTE = 416;     ///< The job number that the program read where it began.

/// What the controller warns of, by the number that rgen shows.
enum class EAlarm : std::int32_t
{
    None = -1,
    AxisTooFast = 159,    ///< E159: an axis would have had to go faster than it can.
    NotExecutable = 1554, ///< E01554: a trajectory's point came while no program waited in playback.
};
/// Asked when a program has begun, and when it is at its good end: whether it fails there.
using ProgramJudge = std::function<bool(int number, bool bAtStart)>;
/// Asked when a client writes a relay: whether another value is stored.
using RelayJudge = std::function<bool()>;

/// What an operator or a client has set and what nothing but the answers depends on.
struct ControllerSettings
{
    std::array<std::optional<Tool>, TOOLS> tools;
    int toolNo = 0;
    int coordinates = 1; ///< As crd_sys has it: 0 axis, 1 orthogonal, 2 user, 3 tool.
    int userCoordinates = 0;
    OperatingConditions conditions;
    bool bTrajectoryLog = false;
};

/// The simulated controller behind the endpoints: motor, base task, relays, arm. Advance brings it to the present; the
/// other methods act at that time. Pure: the time is the caller's.
class ControllerMachine
{
    Core::Logger _logger;
    ControllerVersion _version;
    std::string _robotModel;
    double _timeScale;
    Core::SteadyTime _startedAt;
    Core::Duration _now{}; ///< Simulated, since _startedAt.
    bool _bRemote = true;
    bool _bEmergencyStop = false;
    MotorSwitch _motor;
    ProgramRunner _runner;
    ConsoleProgram _console;
    Arm _arm;
    EAlarm _alarm = EAlarm::None;
    ProgramEvents _events;
    RelayMemory _relays;
    ControllerSettings _settings;
    bool _bProtectiveStop = false;
    bool _bCursorMoved = false; ///< By a start or stop: no selection before SetCursor.
    ProgramJudge _shouldFail;
    RelayJudge _storesWrongValue;
    FloorWork _floorWork;

public:
    ControllerMachine(const ControllerOptions& options, Core::Now now, Core::Logger logger);

    void Advance(Core::Now now);

    /// When it next does something that others notice although no client asks: the running program ends. Advance then.
    [[nodiscard]] std::optional<Core::SteadyTime> GetNextTimeOrNull() const;

    /// Each of these returns None where it was done.
    [[nodiscard]] EApiError SwitchMotorOn();
    [[nodiscard]] EApiError StartProgram();
    [[nodiscard]] EApiError SelectProgram(int number);

    /// Whether a selection may come at all: external ones (ext_sel 1) in remote mode, others outside of it, and none while
    /// a program plays.
    [[nodiscard]] EApiError CheckSelection(bool bExternal) const;
    /// set_cur_pc_idx of task 0: a selection may follow.
    [[nodiscard]] EApiError SetCursor();
    /// The console's program leaves the wait at which it stands.
    [[nodiscard]] EApiError ReleaseWait();

    /// The base task's single move; the program must not run. Gives up a program that was stopped in its middle.
    [[nodiscard]] EApiError ExecuteMove(std::string_view statement);
    /// Runs what AddStatement has put together.
    [[nodiscard]] EApiError StartConsole();
    /// Language where it is no statement that the simulator knows.
    [[nodiscard]] EApiError AddStatement(std::string_view statement);
    void ClearConsole();
    /// The console's program ends, and its statements are forgotten. A selected program is not touched.
    void ExitConsole();

    /// joint_traject_init: the arm stops where it is, the buffer is empty, the alarm forgotten.
    [[nodiscard]] EApiError InitTrajectory(const TrajectoryAgility& agility);
    /// joint_traject_insert_point; BadInput where its time is not after that of the point before.
    [[nodiscard]] EApiError InsertPoint(const StreamedPoint& point);
    /// joint_traject_insert_points, all or nothing.
    [[nodiscard]] TrajectoryError InsertPoints(const TimedPoints& points);
    /// joint_traject_off: the rest of the points is dropped.
    [[nodiscard]] EApiError FinishTrajectory();
    /// STOP control: nothing is left in the buffer, the arm stands. A program runs on.
    void StopTrajectory();

    void SwitchMotorOff();
    void StopProgram();
    void ResetTasks();
    /// No program is selected any more. None may play.
    void ClearSelection();

    /// By the operator's hand. Both stop the program; pressing the emergency stop takes the motor's power too.
    void PressEmergencyStop(bool bPressed);
    void TurnModeSwitch(bool bRemote);

    /// The safeguard opens, which stops the program and takes the motor's power, or closes.
    void HoldProtectiveStop(bool bHeld);

    /// Who lets programs fail; at first nobody.
    void SetProgramJudge(ProgramJudge shouldFail);
    /// Who lets wrong values be stored; at first no one.
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
    /// A trajectory's point would be taken.
    [[nodiscard]] bool IsTrajectoryReady() const;

    /// 0 at the program's beginning, else 1 to 10 in step with its time.
    [[nodiscard]] int GetStep() const noexcept;

    /// Velocities as a client sees them: degrees in a real second.
    [[nodiscard]] JointStates GetJointStates() const;

private:
    void HandleEvents(Core::Duration elapsed);
    void BeginWork();
    /// Makes a good end a failed one where the program cannot do its work.
    void FinishWork(ProgramEvent& event);
    void Count(std::size_t byte);
    void HaltProgram();
    void GiveProgramUp();
    void RaiseAlarm(EAlarm alarm);
    [[nodiscard]] ProgramProgress GetProgress() const;
    [[nodiscard]] EApiError CheckMotion() const;
    [[nodiscard]] EApiError AcceptTrajectory();
};

} // namespace ACS::OpenStreamSim
