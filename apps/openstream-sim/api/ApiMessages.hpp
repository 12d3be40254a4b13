#pragma once

#include <acs/core/JsonText.hpp>

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace ACS::OpenStreamSim
{

/// GET /api/health
struct HealthAnswer
{
    std::string status = "ok";
};

/// GET /project/robot
struct RobotAnswer
{
    std::string status = "ok";
    int motorOnState = 0;
    int isPlayback = 0;
    int isRemoteMode = 0;
    int toolNo = 0;
    int programNo = 0;
    int alarm = -1;                   ///< The last one; -1: none.
    std::span<const double> position; ///< deg
};

/// GET …/joint_states. Views, because it is read at the shortest period.
struct JointStatesAnswer
{
    std::span<const double> position; ///< deg
    std::span<const double> velocity; ///< deg/s
    std::span<const double> effort;   ///< Nm
};

/// GET /project/robot/po_cur. Members that the requested coordinates do not have are omitted.
struct PoseAnswer
{
    int nsync = 0;
    int mechinfo = 1;
    std::string crd;
    std::optional<double> x, y, z;                ///< mm
    std::optional<double> rx, ry, rz;             ///< deg
    std::optional<double> j1, j2, j3, j4, j5, j6; ///< deg
    std::span<const double> encCur;               ///< Of each axis.
};

/// GET /project/rgen. The lists are views.
struct GeneralAnswer
{
    std::string robotModel;
    int curMode = 0;
    int enableState = 0;
    int isPlayback = 0;
    int isRemoteMode = 0;
    int isExtStart = 0;
    int isExtProgSel = 0;
    int curProgNo = 0;
    int curStepNo = 0;
    int curFuncNo = 0;
    int movProgNo = 0;
    int movStepNo = 0;
    int movFuncNo = 0;
    int spdLev = 5;
    int manualSpdMax = 250;
    int autoSpd = 100;
    int jogInchStatus = 0;
    int stepExecuteUnitStatus = 0;
    int contPath = 0;
    int toolNo = 0;
    int ucrdNo = 0;
    int curCrd = 0;
    int baseIntp = 0;
    int plcMode = 0;
    int taskNo = 0;
    int axisLock = 0;
    int callDepth = 0;
    int callPno = -1;
    int jobState = 0;
    int jobSubState = 0;
    int nextExePno = -1;
    int curMechNo = 0;
    int curMechAxisInfo = 0; ///< A bit for each axis.
    int eidLastErr = -1;     ///< Of the last alarm.
    int eidLastWarn = -1;
    int eidLastNoti = -1;
    int eidLastConOut = -1;
    int eidLastStartStop = -1;
    int eidLastHistory = -1;
    std::span<const int> inPosition; ///< By task: its mechanism is stationary.
    std::span<const int> taskEnable;
    std::span<const int> axisCtrl;
};

/// One number: motor_on_state, emergency_stop, di_val …
struct NumberAnswer
{
    std::int64_t val = 0;
};

struct FloatAnswer
{
    double val = 0.0;
};

struct Tool
{
    double x = 0.0, y = 0.0, z = 0.0;       ///< mm
    double rx = 0.0, ry = 0.0, rz = 0.0;    ///< deg
    double mass = 0.0;                      ///< kg
    double cx = 0.0, cy = 0.0, cz = 0.0;    ///< mm
    double ixx = 0.0, iyy = 0.0, izz = 0.0; ///< kg m²
    double massEsti = 0.0;                  ///< kg
    double bias0 = 0.0, bias1 = 0.0, bias2 = 0.0, bias3 = 0.0, bias4 = 0.0, bias5 = 0.0;
};

/// 1: one cycle, 2: repeat. true, which some clients send, is 1.
struct PlaybackMode
{
    int value = 1;

    bool operator==(const PlaybackMode&) const = default;
};

/// GET and PUT /project/control/op_cnd
struct OperatingConditions
{
    PlaybackMode playbackMode;
    int stepGobackMaxSpd = 100;
    int stepGoFuncEx = 0;
    int funcReexeOnTrace = 0;
    int pathRecovConfirm = 0;
    int playbackSpdRate = 100;
    int robotLock = 0;
    int intpBase = 0;
    int ucrdNum = 0;
    int plcMode = 0;

    bool operator==(const OperatingConditions&) const = default;
};

/// POST …/do_val
struct OutputCommand
{
    std::string type;
    int blkNo = 0;
    std::size_t sigNo = 0;
    double val = 0.0;
};

/// POST /project/plc/set_relay_value
struct RelayCommand
{
    std::string name;
    Core::JsonText value; ///< A number, or a string that holds one.
};

/// POST tool_no
struct ToolCommand
{
    int val = 0;
};

/// POST crd_sys
struct CoordinatesCommand
{
    int val = 0; ///< -1: the next one.
};

struct CoordinatesAnswer
{
    int curCrd = 0;
    int ucrdNo = 0;
};

/// POST emergency_stop. In the manuals the body is empty and presses; 0 releases, which only the simulator has.
struct EmergencyStopCommand
{
    int val = 1;
};

/// POST …/cur_prog_cnt; -1: unchanged.
struct ProgramCounterCommand
{
    int pno = -1;
    int sno = -1;
    int fno = -1;
    int extSel = 0; ///< 1: from outside, in remote mode.
};

struct ProgramCounterAnswer
{
    int snoNew = 0;
    int fnoNew = 0;
    int lnNew = 0;
    int ofsMoved = 0;
};

/// POST …/execute_move
struct MoveCommand
{
    std::string stmt;
};

/// POST /console/execute_cmd
struct ConsoleCommand
{
    std::string cmdLine;
};

/// The answer to an unknown console command.
struct ConsoleAnswer
{
    int ecode = 1;
};

/// GET …/joint_traject_mode
struct ModeAnswer
{
    bool bMode = false;
};

/// GET …/joint_traject_ready
struct ReadyAnswer
{
    bool bReady = false;
};

/// POST …/joint_traject_log
struct LogCommand
{
    bool bEnable = false;
};

/// POST …/set_cur_pc_idx
struct PcIndexCommand
{
    int idx = 0;
};

/// POST /project/service/r_code/execute, and its answer.
struct ServiceCode
{
    int code = 0;
};

struct ModuleVersion
{
    std::string name;
    std::string ver;
    std::string buildDate;
    std::string buildTime;
    std::string commitID;
};

/// GET /versions/sysver
struct VersionsAnswer
{
    std::vector<ModuleVersion> modules;
};

/// The body of a refusal.
struct ErrorAnswer
{
    std::int32_t errCode = 0;
    std::string errMsg;
};

} // namespace ACS::OpenStreamSim
