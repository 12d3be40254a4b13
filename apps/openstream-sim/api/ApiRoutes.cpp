#include "api/ApiRoutes.hpp"

#include "api/ApiAnswers.hpp"
#include "api/ApiCall.hpp"
#include "api/ControlApi.hpp"
#include "api/RobotApi.hpp"
#include "api/TrajectoryApi.hpp"

#include <fmt/format.h>

#include <array>

namespace ACS::OpenStreamSim
{

namespace
{

using enum OpenStream::EApiMethod;

/// Which versions of the controller serve an endpoint.
enum class EServed : std::uint8_t
{
    Always,
    BeforeRCode, ///< Then it is withdrawn: 403.
    SinceRCode,  ///< Before, there is no such path: 404.
};

struct ApiRoute
{
    OpenStream::EApiMethod method;
    std::string_view pattern;
    ApiHandler handler;
    EServed served = EServed::Always;
};

constexpr std::array ROUTES{
    ApiRoute{Get, "/api/health", RobotApi::GetHealth},
    ApiRoute{Get, "/api_ver", RobotApi::GetApiVersion},
    ApiRoute{Get, "/versions/sysver", RobotApi::GetSystemVersions},

    ApiRoute{Get, "/project/robot", RobotApi::GetRobot},
    ApiRoute{Get, "/project/robot/joints/joint_states", RobotApi::GetJointStates},
    ApiRoute{Get, "/project/robot/joint_states", RobotApi::GetJointStates},
    ApiRoute{Get, "/project/robot/po_cur", RobotApi::GetPose},
    ApiRoute{Get, "/project/rgen", RobotApi::GetGeneral},
    ApiRoute{Get, "/project/robot/motor_on_state", RobotApi::GetMotorState},
    ApiRoute{Post, "/project/robot/motor_on", RobotApi::SwitchMotorOn},
    ApiRoute{Post, "/project/robot/motor_off", RobotApi::SwitchMotorOff, EServed::BeforeRCode},
    ApiRoute{Get, "/project/robot/emergency_stop", RobotApi::GetEmergencyStop},
    ApiRoute{Post, "/project/robot/emergency_stop", RobotApi::PressEmergencyStop},
    ApiRoute{Get, "/project/robot/cur_tool_data", RobotApi::GetCurrentTool},
    ApiRoute{Get, "/project/robot/tools", RobotApi::GetTools},
    ApiRoute{Get, "/project/robot/tools/t_{}", RobotApi::GetTool},
    ApiRoute{Post, "/project/robot/tool_no", RobotApi::SelectTool},
    ApiRoute{Post, "/project/robot/crd_sys", RobotApi::SelectCoordinates},

    ApiRoute{Post, "/project/robot/trajectory/joint_traject_init", TrajectoryApi::Init},
    ApiRoute{Post, "/project/robot/trajectory/joint_traject_insert_point", TrajectoryApi::InsertPoint},
    ApiRoute{Post, "/project/robot/trajectory/joint_traject_insert_points", TrajectoryApi::InsertPoints},
    ApiRoute{Get, "/project/robot/trajectory/joint_traject_buf_avail", TrajectoryApi::GetFree},
    ApiRoute{Get, "/project/robot/trajectory/joint_traject_agility_info", TrajectoryApi::GetAgility},
    ApiRoute{Get, "/project/robot/trajectory/joint_traject_mode", TrajectoryApi::GetMode},
    ApiRoute{Get, "/project/robot/trajectory/joint_traject_ready", TrajectoryApi::GetReady},
    ApiRoute{Post, "/project/robot/trajectory/joint_traject_off", TrajectoryApi::Finish},
    ApiRoute{Get, "/project/robot/trajectory/joint_traject_log", TrajectoryApi::GetLog},
    ApiRoute{Post, "/project/robot/trajectory/joint_traject_log", TrajectoryApi::SetLog},

    ApiRoute{Post, "/project/robot/start", ControlApi::StartProgram},
    ApiRoute{Post, "/project/robot/stop", ControlApi::StopProgram},
    ApiRoute{Post, "/project/context/tasks/reset", ControlApi::ResetTasks, EServed::BeforeRCode},
    ApiRoute{Post, "/project/context/tasks[{}]/reset", ControlApi::ResetTask, EServed::BeforeRCode},
    ApiRoute{Post, "/project/service/r_code/execute", ControlApi::ExecuteServiceCode, EServed::SinceRCode},
    ApiRoute{Post, "/project/context/tasks[0]/cur_prog_cnt", ControlApi::SetProgramCounter},
    ApiRoute{Post, "/project/context/tasks[{}]/set_cur_pc_idx", ControlApi::SetPcIndex},
    ApiRoute{Post, "/project/context/tasks[0]/release_wait", ControlApi::ReleaseWait},
    ApiRoute{Post, "/project/context/tasks[{}]/execute_move", ControlApi::ExecuteMove},
    ApiRoute{Post, "/console/execute_cmd", ControlApi::ExecuteCommand},

    ApiRoute{Get, "/project/control/op_cnd", ControlApi::GetConditions},
    ApiRoute{Put, "/project/control/op_cnd", ControlApi::SetConditions},
    ApiRoute{Post, "/project/control/op_cnd", ControlApi::SetConditions},
    ApiRoute{Get, "/project/control/ios/dio/di_val", ControlApi::GetInput},
    ApiRoute{Get, "/project/control/ios/dio/do_val", ControlApi::GetOutput},
    ApiRoute{Post, "/project/control/ios/dio/do_val", ControlApi::SetOutput},
    ApiRoute{Get, "/project/control/ios/sio/si_val", ControlApi::GetSystemInput},
    ApiRoute{Get, "/project/control/ios/sio/so_val", ControlApi::GetSystemOutput},
    ApiRoute{Get, "/project/plc/{}/val_s32", ControlApi::GetRelayWords},
    ApiRoute{Post, "/project/plc/set_relay_value", ControlApi::SetRelay}};

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
    const bool bRCode = machine.GetVersion() >= FIRST_WITH_R_CODE;
    bool bOtherMethod = false;
    for (const ApiRoute& route : ROUTES)
    {
        ApiCall call{request, {}, room};
        const bool bNotYet = route.served == EServed::SinceRCode && !bRCode;
        if (bNotYet || !MatchesPattern(request.path, route.pattern, call.argument))
        {
            continue;
        }
        if (route.method == request.method)
        {
            const bool bWithdrawn = route.served == EServed::BeforeRCode && bRCode;
            return bWithdrawn ? Answer(EApiError::Withdrawn) : route.handler(machine, call);
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
