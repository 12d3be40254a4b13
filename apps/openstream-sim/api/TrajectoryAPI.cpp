#include "api/TrajectoryAPI.hpp"

#include "api/ApiAnswers.hpp"
#include "arm/TrajectoryPoints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace ACS::OpenStreamSim::TrajectoryAPI
{

namespace
{

using OpenStream::ApiResponse;

} // namespace

ApiResponse Init(ControllerMachine& machine, const TrajectoryAgility& agility)
{
    return Answer(machine.InitTrajectory(agility));
}

ApiResponse InsertPoint(ControllerMachine& machine, const StreamedPoint& point)
{
    JointVector position{};
    std::ranges::copy(point.point, position.begin());
    const std::size_t outside = FindAxisOutside(position);
    if (outside != AXES)
    {
        const AxisLimits& limits = AXIS_LIMITS.at(outside);
        return RefuseInput(
            fmt::format("point[{}]", outside),
            fmt::format("an angle from {} to {} deg", limits.lowest, limits.highest),
            fmt::to_string(position.at(outside)));
    }
    const EApiError error = machine.InsertPoint(point);
    if (error == EApiError::BadInput)
    {
        return RefuseInput(
            "time_from_start",
            fmt::format("more than {} s, the time of the previous point", machine.GetTrajectory().GetNewestTime()),
            fmt::to_string(point.timeFromStart));
    }
    return Answer(error);
}

ApiResponse InsertPoints(ControllerMachine& machine, const ApiCall& call)
{
    TimedPoints points;
    TrajectoryError error = ReadTrajectory(call.request.body, points);
    if (error.notNow == EApiError::BadInput)
    {
        return RefuseInput("body", "an object with joint_names and points", std::move(error.sentence));
    }
    if (error.code == ETrajectoryError::None)
    {
        error = machine.InsertPoints(points);
    }
    if (error.code != ETrajectoryError::None)
    {
        return Forbid(static_cast<std::int32_t>(error.code), std::move(error.sentence));
    }
    return Answer(error.notNow);
}

ApiResponse GetFree(ControllerMachine& machine, const ApiCall& call)
{
    const NumberAnswer answer{static_cast<std::int64_t>(machine.GetTrajectory().GetFree())};
    return Succeed(answer, OBJECT_TYPE, std::move(call.room));
}

ApiResponse GetAgility(ControllerMachine& machine, const ApiCall& /*call*/)
{
    return Succeed(machine.GetTrajectory().GetAgility());
}

ApiResponse GetMode(ControllerMachine& machine, const ApiCall& call)
{
    return Succeed(ModeAnswer{machine.IsTrajectoryActive()}, OBJECT_TYPE, std::move(call.room));
}

ApiResponse GetReady(ControllerMachine& machine, const ApiCall& call)
{
    return Succeed(ReadyAnswer{machine.IsTrajectoryReady()}, OBJECT_TYPE, std::move(call.room));
}

ApiResponse Finish(ControllerMachine& machine, const ApiCall& /*call*/)
{
    return Answer(machine.FinishTrajectory());
}

ApiResponse GetLog(ControllerMachine& machine, const ApiCall& /*call*/)
{
    return Succeed(NumberAnswer{machine.GetSettings().bTrajectoryLog ? 1 : 0});
}

ApiResponse SetLog(ControllerMachine& machine, const LogCommand& command)
{
    machine.GetSettings().bTrajectoryLog = command.bEnable;
    return Succeed();
}

} // namespace ACS::OpenStreamSim::TrajectoryAPI
