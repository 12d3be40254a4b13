#include "controller/VirtualController.hpp"

#include "api/ApiRoutes.hpp"

#include <string>
#include <string_view>
#include <utility>

namespace ACS::OpenStreamSim
{

namespace
{

constexpr std::string_view SHORT_PREFIX = "/robot/";
constexpr std::string_view PROJECT = "/project";

/// Builds a new string: replacing in place makes an optimising g++ 12 warn of copies that cannot happen (-Wrestrict).
std::string ReplaceAll(std::string_view text, std::string_view part, char replacement)
{
    std::string result;
    std::size_t start = 0;
    for (std::size_t at = text.find(part); at != std::string_view::npos; at = text.find(part, start))
    {
        result.append(text.substr(start, at - start)).push_back(replacement);
        start = at + part.size();
    }
    return result.append(text.substr(start));
}

/// Strict clients encode the brackets of tasks[0], and a manual's own sample shortens /project/robot/start.
std::string MakePlainPath(std::string path)
{
    path = ReplaceAll(path, "%5B", '[');
    path = ReplaceAll(path, "%5b", '[');
    path = ReplaceAll(path, "%5D", ']');
    path = ReplaceAll(path, "%5d", ']');
    if (path.starts_with(SHORT_PREFIX))
    {
        path.insert(0, PROJECT);
    }
    return path;
}

bool IsPlainPath(std::string_view path)
{
    return path.find('%') == std::string_view::npos && !path.starts_with(SHORT_PREFIX);
}

} // namespace

VirtualController::VirtualController(const ControllerOptions& options, Core::Now now, Core::Logger logger)
    : _machine(options, now, std::move(logger))
{
}

void VirtualController::Call(const OpenStream::ApiRequest& request, Core::Now now, OpenStream::ApiResponse& response)
{
    _machine.Advance(now);
    if (IsPlainPath(request.path))
    {
        response = Route(_machine, request, response.TakeRoom());
        return;
    }
    OpenStream::ApiRequest plain = request;
    plain.path = MakePlainPath(std::move(plain.path));
    response = Route(_machine, plain, response.TakeRoom());
}

void VirtualController::StopControl(Core::Now now)
{
    _machine.Advance(now);
    _machine.StopTrajectory();
}

void VirtualController::TurnModeSwitch(bool bRemote, Core::Now now)
{
    _machine.Advance(now);
    _machine.TurnModeSwitch(bRemote);
}

std::optional<Core::SteadyTime> VirtualController::GetNextTimeOrNull() const
{
    return _machine.GetNextTimeOrNull();
}

ControllerMachine& VirtualController::GetMachine(Core::Now now)
{
    _machine.Advance(now);
    return _machine;
}

} // namespace ACS::OpenStreamSim
