#include "api/ApiRoutes.hpp"

#include "api/ApiAnswers.hpp"
#include "api/ApiCall.hpp"
#include "api/ControlAPI.hpp"
#include "api/RobotAPI.hpp"
#include "api/TrajectoryAPI.hpp"

#include <fmt/format.h>

#include <array>

namespace ACS::OpenStreamSim
{

namespace
{

using enum OpenStream::EApiMethod;

constexpr ControllerVersion ALWAYS{0, 0, 0};
constexpr ControllerVersion NEVER{100, 0, 0};
constexpr ControllerVersion FIRST_WITH_CONSOLE{60, 28, 0};
constexpr ControllerVersion FIRST_WITH_EMERGENCY_STOP{60, 30, 0};
constexpr ControllerVersion FIRST_WITH_TRAJECTORIES{60, 32, 0};
constexpr ControllerVersion FIRST_WITH_STREAMED_POINTS{60, 34, 0};
constexpr ControllerVersion FIRST_WITH_JOINT_STATES{60, 34, 0};

template <auto HANDLE>
struct BodyHandler;

template <typename TBody, OpenStream::ApiResponse (*HANDLE)(ControllerMachine&, const TBody&)>
struct BodyHandler<HANDLE>
{
    static OpenStream::ApiResponse Call(ControllerMachine& machine, const ApiCall& call)
    {
        const Core::Result<TBody> body = ReadBody<TBody>(call.request);
        return body.has_value() ? HANDLE(machine, *body) : Refuse(body.error());
    }
};

/// The handler of a function that needs only the body of the call; 400 if the body is invalid.
template <auto HANDLE>
constexpr ApiHandler WITH_BODY = BodyHandler<HANDLE>::Call;

struct ApiRoute
{
    OpenStream::EApiMethod method;
    std::string_view pattern;
    ApiHandler handler;
    ControllerVersion since = ALWAYS;         ///< Earlier versions answer 404.
    ControllerVersion withdrawnSince = NEVER; ///< It and later versions answer 403.
};

constexpr std::array ROUTES{
    ApiRoute{Get, "/api/health", RobotAPI::GetHealth},
    ApiRoute{Get, "/api_ver", RobotAPI::GetApiVersion},
    ApiRoute{Get, "/versions/sysver", RobotAPI::GetSystemVersions},

    ApiRoute{Get, "/project/robot", RobotAPI::GetRobot},
    ApiRoute{Get, "/project/robot/joints/joint_states", RobotAPI::GetJointStates, FIRST_WITH_JOINT_STATES},
    ApiRoute{Get, "/project/robot/joint_states", RobotAPI::GetJointStates, FIRST_WITH_JOINT_STATES},
    ApiRoute{Get, "/project/robot/po_cur", RobotAPI::GetPose},
    ApiRoute{Get, "/project/rgen", RobotAPI::GetGeneral},
    ApiRoute{Get, "/project/robot/motor_on_state", RobotAPI::GetMotorState},
    ApiRoute{Post, "/project/robot/motor_on", RobotAPI::SwitchMotorOn},
    ApiRoute{Post, "/project/robot/motor_off", RobotAPI::SwitchMotorOff, ALWAYS, FIRST_WITH_R_CODE},
    ApiRoute{Get, "/project/robot/emergency_stop", RobotAPI::GetEmergencyStop, FIRST_WITH_EMERGENCY_STOP},
    ApiRoute{Post, "/project/robot/emergency_stop", WITH_BODY<RobotAPI::PressEmergencyStop>, FIRST_WITH_EMERGENCY_STOP},
    ApiRoute{Get, "/project/robot/cur_tool_data", RobotAPI::GetCurrentTool},
    ApiRoute{Get, "/project/robot/tools", RobotAPI::GetTools},
    ApiRoute{Get, "/project/robot/tools/t_{}", RobotAPI::GetTool},
    ApiRoute{Post, "/project/robot/tool_no", WITH_BODY<RobotAPI::SelectTool>},
    ApiRoute{Post, "/project/robot/crd_sys", WITH_BODY<RobotAPI::SelectCoordinates>},

    ApiRoute{
        Post,
        "/project/robot/trajectory/joint_traject_init",
        WITH_BODY<TrajectoryAPI::Init>,
        FIRST_WITH_TRAJECTORIES},
    ApiRoute{
        Post,
        "/project/robot/trajectory/joint_traject_insert_point",
        WITH_BODY<TrajectoryAPI::InsertPoint>,
        FIRST_WITH_STREAMED_POINTS},
    ApiRoute{
        Post,
        "/project/robot/trajectory/joint_traject_insert_points",
        TrajectoryAPI::InsertPoints,
        FIRST_WITH_TRAJECTORIES},
    ApiRoute{Get, "/project/robot/trajectory/joint_traject_buf_avail", TrajectoryAPI::GetFree, FIRST_WITH_TRAJECTORIES},
    ApiRoute{
        Get,
        "/project/robot/trajectory/joint_traject_agility_info",
        TrajectoryAPI::GetAgility,
        FIRST_WITH_AGILITY},
    ApiRoute{Get, "/project/robot/trajectory/joint_traject_mode", TrajectoryAPI::GetMode, FIRST_WITH_TRAJECTORY_MODE},
    ApiRoute{Get, "/project/robot/trajectory/joint_traject_ready", TrajectoryAPI::GetReady, FIRST_WITH_TRAJECTORY_MODE},
    ApiRoute{Post, "/project/robot/trajectory/joint_traject_off", TrajectoryAPI::Finish, FIRST_WITH_TRAJECTORY_MODE},
    ApiRoute{Get, "/project/robot/trajectory/joint_traject_log", TrajectoryAPI::GetLog, FIRST_WITH_AGILITY},
    ApiRoute{Post, "/project/robot/trajectory/joint_traject_log", WITH_BODY<TrajectoryAPI::SetLog>, FIRST_WITH_AGILITY},

    ApiRoute{Post, "/project/robot/start", ControlAPI::StartProgram},
    ApiRoute{Post, "/project/robot/stop", ControlAPI::StopProgram},
    ApiRoute{Post, "/project/context/tasks/reset", ControlAPI::ResetTasks, ALWAYS, FIRST_WITH_R_CODE},
    ApiRoute{Post, "/project/context/tasks[{}]/reset", ControlAPI::ResetTask, ALWAYS, FIRST_WITH_R_CODE},
    ApiRoute{Post, "/project/service/r_code/execute", WITH_BODY<ControlAPI::ExecuteServiceCode>, FIRST_WITH_R_CODE},
    ApiRoute{Post, "/project/context/tasks[0]/cur_prog_cnt", WITH_BODY<ControlAPI::SetProgramCounter>},
    ApiRoute{Post, "/project/context/tasks[{}]/set_cur_pc_idx", ControlAPI::SetPcIndex},
    ApiRoute{Post, "/project/context/tasks[0]/release_wait", ControlAPI::ReleaseWait},
    ApiRoute{Post, "/project/context/tasks[{}]/execute_move", ControlAPI::ExecuteMove, FIRST_WITH_CONSOLE},
    ApiRoute{Post, "/console/execute_cmd", WITH_BODY<ControlAPI::ExecuteCommand>, FIRST_WITH_CONSOLE},

    ApiRoute{Get, "/project/control/op_cnd", ControlAPI::GetConditions},
    ApiRoute{Put, "/project/control/op_cnd", ControlAPI::SetConditions},
    ApiRoute{Post, "/project/control/op_cnd", ControlAPI::SetConditions},
    ApiRoute{Get, "/project/control/ios/dio/di_val", ControlAPI::GetInput},
    ApiRoute{Get, "/project/control/ios/dio/do_val", ControlAPI::GetOutput},
    ApiRoute{Post, "/project/control/ios/dio/do_val", WITH_BODY<ControlAPI::SetOutput>},
    ApiRoute{Get, "/project/control/ios/sio/si_val", ControlAPI::GetSystemInput},
    ApiRoute{Get, "/project/control/ios/sio/so_val", ControlAPI::GetSystemOutput},
    ApiRoute{Get, "/project/plc/{}/val_s32", ControlAPI::GetRelayWords},
    ApiRoute{Post, "/project/plc/set_relay_value", WITH_BODY<ControlAPI::SetRelay>}};

} // namespace

bool MatchesPattern(std::string_view path, std::string_view pattern, std::string_view& argumentOut)
{
    constexpr std::string_view PLACE = "{}";
    const std::size_t place = pattern.find(PLACE);
    if (place == std::string_view::npos)
    {
        return path == pattern;
    }
    const std::string_view before = pattern.substr(0, place);
    const std::string_view after = pattern.substr(place + PLACE.size());
    if (path.size() <= before.size() + after.size() || !path.starts_with(before) || !path.ends_with(after))
    {
        return false;
    }
    argumentOut = path.substr(before.size(), path.size() - before.size() - after.size());
    return argumentOut.find('/') == std::string_view::npos;
}

OpenStream::ApiResponse Route(ControllerMachine& machine, const OpenStream::ApiRequest& request, std::string room)
{
    const ControllerVersion& version = machine.GetVersion();
    bool bOtherMethod = false;
    for (const ApiRoute& route : ROUTES)
    {
        ApiCall call{request, {}, room};
        if (version < route.since || !MatchesPattern(request.path, route.pattern, call.argument))
        {
            continue;
        }
        if (route.method == request.method)
        {
            return version >= route.withdrawnSince ? Answer(EApiError::Withdrawn) : route.handler(machine, call);
        }
        bOtherMethod = true;
    }
    return RefusePath(fmt::format(
        "the simulator does not serve {} {}{}",
        OpenStream::GetMethodText(request.method),
        Core::QuoteForError(request.path),
        bOtherMethod ? ", only another method" : ""));
}

} // namespace ACS::OpenStreamSim
