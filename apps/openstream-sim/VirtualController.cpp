#include "VirtualController.hpp"

#include "ApiRoutes.hpp"

#include <string>
#include <string_view>
#include <utility>

namespace ACS::OpenStreamSim
{

namespace
{

constexpr std::string_view SHORT_PREFIX = "/robot/";
constexpr std::string_view PROJECT = "/project";

void ReplaceAll(std::string& text, std::string_view part, std::string_view replacement)
{
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + replacement.size()))
    {
        text.replace(at, part.size(), replacement);
    }
}

/// Strict clients encode the brackets of tasks[0], and a manual's own sample shortens /project/robot/start.
std::string MakePlainPath(std::string path)
{
    ReplaceAll(path, "%5B", "[");
    ReplaceAll(path, "%5b", "[");
    ReplaceAll(path, "%5D", "]");
    ReplaceAll(path, "%5d", "]");
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

OpenStream::ApiResponse VirtualController::Call(const OpenStream::ApiRequest& request, Core::Now now)
{
    _machine.Advance(now);
    if (IsPlainPath(request.path))
    {
        return Route(_machine, request);
    }
    OpenStream::ApiRequest plain = request;
    plain.path = MakePlainPath(std::move(plain.path));
    return Route(_machine, plain);
}

void VirtualController::StopControl(Core::Now now)
{
    _machine.Advance(now);
}

void VirtualController::TurnModeSwitch(bool bRemote, Core::Now now)
{
    _machine.Advance(now);
    _machine.TurnModeSwitch(bRemote);
}

} // namespace ACS::OpenStreamSim
