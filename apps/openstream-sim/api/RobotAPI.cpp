#include "api/RobotAPI.hpp"

#include "api/ApiAnswers.hpp"
#include "arm/FlangePose.hpp"
#include "common/Version.hpp"
#include <acs/core/ParseNumber.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <utility>

namespace ACS::OpenStreamSim::RobotAPI
{

namespace
{

using OpenStream::ApiResponse;

constexpr std::int64_t API_VERSION = 5;
constexpr int AUTO_ONE_CYCLE = 3;
constexpr int MANUAL_MODE = 0;
constexpr int DEADMAN_HELD = 0x100; ///< Second byte of enable_state.
constexpr std::size_t TASKS = 8;
constexpr std::size_t AXIS_SLOTS = 32;
constexpr int COORDINATE_SYSTEMS = 4;
constexpr int ALL_MECHANISMS = 65'535;
constexpr int ALL_AXES = (1 << AXES) - 1;
constexpr double STANDING_SPEED = 0.01;     ///< deg/s, at most.
constexpr double ENCODER_COUNTS = 10'000.0; ///< In a degree.

/// The `crd` of po_cur.
enum class EPoseCoordinates : std::uint8_t
{
    Base = 0,
    Robot = 1,
    Axis = 2,
    Encoder = 3,
    User = 4,
};

/// The `val` of crd_sys that means axes.
constexpr int AXIS_COORDINATES = 0;

int ToInteger(bool bValue)
{
    return bValue ? 1 : 0;
}

void FillCartesian(const JointVector& position, PoseAnswer& answer)
{
    const FlangePose pose = ComputeFlangePose(position);
    answer.x = pose.x;
    answer.y = pose.y;
    answer.z = pose.z;
    answer.rx = pose.rx;
    answer.ry = pose.ry;
    answer.rz = pose.rz;
}

void FillAxes(const JointVector& position, PoseAnswer& answer)
{
    answer.j1 = position[0];
    answer.j2 = position[1];
    answer.j3 = position[2];
    answer.j4 = position[3];
    answer.j5 = position[4];
    answer.j6 = position[5];
}

JointVector ToEncoderCounts(const JointVector& position)
{
    JointVector counts{};
    std::ranges::transform(position, counts.begin(), [](double angle) { return std::round(angle * ENCODER_COUNTS); });
    return counts;
}

bool IsStanding(const JointVector& velocity)
{
    return std::ranges::all_of(velocity, [](double speed) { return std::abs(speed) <= STANDING_SPEED; });
}

std::span<const double> Cut(const JointVector& values, std::size_t first, std::size_t count)
{
    return std::span(values).subspan(first, count);
}

} // namespace

ApiResponse GetHealth(ControllerMachine& /*machine*/, const ApiCall& /*call*/)
{
    return Succeed(HealthAnswer{});
}

ApiResponse GetApiVersion(ControllerMachine& /*machine*/, const ApiCall& /*call*/)
{
    return ApiResponse{200, Core::JsonText::FromInteger(API_VERSION)};
}

ApiResponse GetSystemVersions(ControllerMachine& machine, const ApiCall& /*call*/)
{
    // Clients read the version of "com" as a number and require at least 60.
    const std::string version = MakeText(machine.GetVersion());
    VersionsAnswer answer;
    for (const char* name : {"com", "tp"})
    {
        answer.modules.push_back(ModuleVersion{name, version, "2025-01-01", "00:00:00", std::string(Apps::VERSION)});
    }
    return Succeed(answer);
}

ApiResponse GetRobot(ControllerMachine& machine, const ApiCall& call)
{
    RobotAnswer answer;
    answer.motorOnState = static_cast<int>(machine.GetMotorState());
    answer.isPlayback = ToInteger(machine.IsPlaying());
    answer.isRemoteMode = ToInteger(machine.IsRemote());
    answer.toolNo = machine.GetSettings().toolNo;
    answer.programNo = machine.GetProgram();
    answer.alarm = static_cast<int>(machine.GetAlarm());
    const JointVector position = machine.GetJointStates().position;
    answer.position = position;
    return Succeed(answer, OBJECT_TYPE, std::move(call.room));
}

ApiResponse GetJointStates(ControllerMachine& machine, const ApiCall& call)
{
    constexpr auto LAST = static_cast<std::int64_t>(AXES);
    const Core::Result<std::int64_t> start = ReadInteger(call.request, "jno_start", 1, 1, LAST);
    if (!start.has_value())
    {
        return Refuse(start.error());
    }
    const std::int64_t rest = LAST - *start + 1;
    const Core::Result<std::int64_t> count = ReadInteger(call.request, "jno_n", rest, 1, rest);
    if (!count.has_value())
    {
        return Refuse(count.error());
    }
    const auto first = static_cast<std::size_t>(*start - 1);
    const auto size = static_cast<std::size_t>(*count);
    const JointStates states = machine.GetJointStates();
    const JointStatesAnswer answer{
        Cut(states.position, first, size),
        Cut(states.velocity, first, size),
        Cut(states.effort, first, size)};
    return Succeed(answer, OBJECT_TYPE, std::move(call.room));
}

ApiResponse GetPose(ControllerMachine& machine, const ApiCall& call)
{
    constexpr std::int64_t LAST_TASK = 7;
    constexpr std::int64_t LAST_USER_COORDINATES = 20;
    constexpr auto LAST_CRD = static_cast<std::int64_t>(EPoseCoordinates::User);
    const Core::Result<std::int64_t> task = ReadInteger(call.request, "task_no", 0, 0, LAST_TASK);
    const Core::Result<std::int64_t> user = ReadInteger(call.request, "ucrd_no", 0, 0, LAST_USER_COORDINATES);
    const Core::Result<std::int64_t> mechanisms = ReadInteger(call.request, "mechinfo", 1, -1, ALL_MECHANISMS);
    const Core::Result<std::int64_t> crd = ReadInteger(call.request, "crd", 0, INT32_MIN, LAST_CRD);
    for (const Core::Result<std::int64_t>* value : {&task, &user, &mechanisms, &crd})
    {
        if (!value->has_value())
        {
            return Refuse(value->error());
        }
    }
    const JointVector position = machine.GetJointStates().position;
    PoseAnswer answer;
    answer.mechinfo = *mechanisms == -1 ? ALL_MECHANISMS : static_cast<int>(*mechanisms);
    answer.crd = "base";
    if (call.request.GetParameterOrNull("crd") == nullptr)
    {
        FillCartesian(position, answer);
        FillAxes(position, answer);
        const JointVector counts = ToEncoderCounts(position);
        answer.encCur = counts;
        return Succeed(answer, "Pose", std::move(call.room));
    }
    const bool bAxes = machine.GetSettings().coordinates == AXIS_COORDINATES;
    const EPoseCoordinates current = bAxes ? EPoseCoordinates::Axis : EPoseCoordinates::Base;
    switch (*crd < 0 ? current : static_cast<EPoseCoordinates>(*crd))
    {
        case EPoseCoordinates::Axis:
            answer.crd = "joint";
            FillAxes(position, answer);
            return Succeed(answer, "Pose", std::move(call.room));
        case EPoseCoordinates::Encoder:
            answer.crd = "encoder";
            FillAxes(ToEncoderCounts(position), answer);
            return Succeed(answer, "Pose", std::move(call.room));
        case EPoseCoordinates::Robot:
            answer.crd = "robot";
            break;
        case EPoseCoordinates::User:
            answer.crd = "user";
            break;
        case EPoseCoordinates::Base:
        default:
            break;
    }
    FillCartesian(position, answer);
    return Succeed(answer, "Pose", std::move(call.room));
}

ApiResponse GetGeneral(ControllerMachine& machine, const ApiCall& call)
{
    const ControllerSettings& settings = machine.GetSettings();
    GeneralAnswer answer;
    answer.robotModel = machine.GetRobotModel();
    answer.curMode = machine.IsRemote() ? AUTO_ONE_CYCLE : MANUAL_MODE;
    answer.enableState = static_cast<int>(machine.GetMotorState()) | DEADMAN_HELD;
    answer.isPlayback = ToInteger(machine.IsPlaying());
    answer.isRemoteMode = ToInteger(machine.IsRemote());
    answer.isExtStart = answer.isRemoteMode;
    answer.isExtProgSel = answer.isRemoteMode;
    answer.curProgNo = machine.GetProgram();
    answer.curStepNo = machine.GetStep();
    answer.movProgNo = answer.curProgNo;
    answer.movStepNo = answer.curStepNo;
    answer.autoSpd = settings.conditions.playbackSpdRate;
    answer.toolNo = settings.toolNo;
    answer.ucrdNo = settings.userCoordinates;
    answer.curCrd = settings.coordinates;
    answer.baseIntp = settings.conditions.intpBase;
    answer.plcMode = settings.conditions.plcMode;
    answer.axisLock = settings.conditions.robotLock;
    answer.curMechAxisInfo = ALL_AXES;
    answer.eidLastErr = static_cast<int>(machine.GetAlarm());
    std::array<int, TASKS> inPosition{};
    inPosition.front() = ToInteger(IsStanding(machine.GetJointStates().velocity));
    answer.inPosition = inPosition;
    std::array<int, TASKS> taskEnable{};
    taskEnable.front() = 1;
    answer.taskEnable = taskEnable;
    std::array<int, AXIS_SLOTS> axisCtrl{};
    std::fill_n(axisCtrl.begin(), AXES, 1);
    answer.axisCtrl = axisCtrl;
    return Succeed(answer, OBJECT_TYPE, std::move(call.room));
}

ApiResponse GetMotorState(ControllerMachine& machine, const ApiCall& call)
{
    const NumberAnswer answer{static_cast<std::int64_t>(machine.GetMotorState())};
    return Succeed(answer, OBJECT_TYPE, std::move(call.room));
}

ApiResponse SwitchMotorOn(ControllerMachine& machine, const ApiCall& /*call*/)
{
    return Answer(machine.SwitchMotorOn());
}

ApiResponse SwitchMotorOff(ControllerMachine& machine, const ApiCall& /*call*/)
{
    machine.SwitchMotorOff();
    return Succeed();
}

ApiResponse GetEmergencyStop(ControllerMachine& machine, const ApiCall& /*call*/)
{
    return Succeed(NumberAnswer{ToInteger(machine.IsEmergencyStop())});
}

ApiResponse PressEmergencyStop(ControllerMachine& machine, const EmergencyStopCommand& command)
{
    machine.PressEmergencyStop(command.val == 1);
    return Succeed();
}

ApiResponse GetCurrentTool(ControllerMachine& machine, const ApiCall& /*call*/)
{
    const ControllerSettings& settings = machine.GetSettings();
    return Succeed(settings.tools.at(static_cast<std::size_t>(settings.toolNo)).value_or(Tool{}), "Tool");
}

ApiResponse GetTools(ControllerMachine& machine, const ApiCall& /*call*/)
{
    std::string text;
    Json::JsonWriter writer(text);
    writer.BeginObject();
    writer.Key("_type");
    writer.WriteString("Tools");
    const auto& tools = machine.GetSettings().tools;
    for (std::size_t number = 0; number < tools.size(); ++number)
    {
        if (tools[number].has_value())
        {
            writer.Key("t_" + std::to_string(number));
            writer.WriteRaw(*Succeed(*tools[number], "Tool").body);
        }
    }
    writer.EndObject();
    return ApiResponse{200, Core::JsonText::FromTrusted(std::move(text))};
}

ApiResponse GetTool(ControllerMachine& machine, const ApiCall& call)
{
    const auto& tools = machine.GetSettings().tools;
    const std::size_t number = Core::ParseNumberOrNull<std::size_t>(call.argument).value_or(tools.size());
    if (number >= tools.size() || !tools[number].has_value())
    {
        return RefusePath("no such tool");
    }
    return Succeed(*tools[number], "Tool");
}

ApiResponse SelectTool(ControllerMachine& machine, const ToolCommand& command)
{
    machine.GetSettings().toolNo = command.val;
    return Succeed();
}

ApiResponse SelectCoordinates(ControllerMachine& machine, const CoordinatesCommand& command)
{
    ControllerSettings& settings = machine.GetSettings();
    settings.coordinates = command.val < 0 ? (settings.coordinates + 1) % COORDINATE_SYSTEMS : command.val;
    return Succeed(CoordinatesAnswer{settings.coordinates, settings.userCoordinates});
}

} // namespace ACS::OpenStreamSim::RobotAPI
