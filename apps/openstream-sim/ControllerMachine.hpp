#pragma once

#include "ApiMessages.hpp"
#include "ArmMotion.hpp"
#include "ControllerOptions.hpp"
#include "EApiError.hpp"
#include "MotorSwitch.hpp"
#include "ProgramRunner.hpp"
#include "RelayMemory.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>

#include <array>
#include <cstddef>
#include <functional>
#include <optional>

namespace ACS::OpenStreamSim
{

inline constexpr std::size_t TOOLS = 32;

/// Where a program tells what became of it: 32-bit words in relay block m, at these bytes.
inline constexpr std::size_t STARTED_BYTE = 400;  ///< Counts programs that began.
inline constexpr std::size_t FINISHED_BYTE = 404; ///< Counts programs that ended well.
inline constexpr std::size_t FAILED_BYTE = 408;   ///< Counts programs that gave up.
inline constexpr std::size_t LAST_BYTE = 412;     ///< The number of the program that ended last.

/// Asked when a program has begun, and when it is at its good end: whether it fails there.
using ProgramJudge = std::function<bool(int number, bool bAtStart)>;

/// What an operator or a client has set and what nothing but the answers depends on.
struct ControllerSettings
{
    std::array<std::optional<Tool>, TOOLS> tools;
    int toolNo = 0;
    int coordinates = 1; ///< As crd_sys has it: 0 axis, 1 orthogonal, 2 user, 3 tool.
    int userCoordinates = 0;
    OperatingConditions conditions;
};

/// The simulated controller behind the endpoints: motor, base task, relays, arm. Advance brings it to the present; the
/// other methods act at that time. Pure: the time is the caller's.
class ControllerMachine
{
    Core::Logger _logger;
    double _timeScale;
    Core::SteadyTime _startedAt;
    Core::Duration _now{}; ///< Simulated, since _startedAt.
    bool _bRemote = true;
    bool _bEmergencyStop = false;
    MotorSwitch _motor;
    ProgramRunner _runner;
    ArmMotion _arm;
    ProgramEvents _events;
    RelayMemory _relays;
    ControllerSettings _settings;
    bool _bProtectiveStop = false;
    ProgramJudge _shouldFail;

    void HandleEvents(Core::Duration elapsed);
    void Count(std::size_t byte);

public:
    ControllerMachine(const ControllerOptions& options, Core::Now now, Core::Logger logger);

    void Advance(Core::Now now);

    /// Each of these returns None where it was done.
    [[nodiscard]] EApiError SwitchMotorOn();
    [[nodiscard]] EApiError StartProgram();
    [[nodiscard]] EApiError SelectProgram(int number);

    void SwitchMotorOff();
    void StopProgram();
    void ResetTasks();

    /// By the operator's hand. Both stop the program; pressing the emergency stop takes the motor's power too.
    void PressEmergencyStop(bool bPressed);
    void TurnModeSwitch(bool bRemote);

    /// The safeguard opens, which stops the program and takes the motor's power, or closes.
    void HoldProtectiveStop(bool bHeld);

    /// Who lets programs fail; at first nobody.
    void SetProgramJudge(ProgramJudge shouldFail);

    [[nodiscard]] RelayMemory& GetRelays() noexcept;
    [[nodiscard]] ControllerSettings& GetSettings() noexcept;

    [[nodiscard]] bool IsRemote() const noexcept;
    [[nodiscard]] bool IsEmergencyStop() const noexcept;
    [[nodiscard]] bool IsPlaying() const noexcept;
    [[nodiscard]] EMotorState GetMotorState() const noexcept;
    [[nodiscard]] int GetProgram() const noexcept;

    /// 0 at the program's beginning, else 1 to 10 in step with its time.
    [[nodiscard]] int GetStep() const noexcept;

    /// Velocities as a client sees them: degrees in a real second.
    [[nodiscard]] JointStates GetJointStates() const;
};

} // namespace ACS::OpenStreamSim
