#pragma once

#include "controller/ControllerMachine.hpp"
#include <acs/openstream/ApiRequest.hpp>

#include <string>
#include <string_view>

namespace ACS::OpenStreamSim
{

/// Whether the path matches this pattern, in which one {} stands for any text without a slash; the argument is a view of
/// the path.
[[nodiscard]] bool MatchesPattern(std::string_view path, std::string_view pattern, std::string_view& argumentOut);

/// Finds the handler in the table of all endpoints and calls it; 404 if there is none in the version of the
/// controller. The path is in its plain form:
/// brackets not encoded, /project/robot not shortened. The room is ApiCall's.
[[nodiscard]] OpenStream::ApiResponse Route(
    ControllerMachine& machine,
    const OpenStream::ApiRequest& request,
    std::string room);

} // namespace ACS::OpenStreamSim
