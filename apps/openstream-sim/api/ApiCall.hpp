#pragma once

#include <acs/openstream/ApiRequest.hpp>

#include <string>
#include <string_view>

namespace ACS::OpenStreamSim
{

class ControllerMachine;

/// One call as a handler sees it.
struct ApiCall
{
    const OpenStream::ApiRequest& request;
    std::string_view argument; ///< What stood in the place of the pattern's {}.
    std::string& room;         ///< Empty: for the answer of what is asked hundreds of times a second.
};

/// Answers one call; the machine has been brought to the present.
using ApiHandler = OpenStream::ApiResponse (*)(ControllerMachine& machine, const ApiCall& call);

} // namespace ACS::OpenStreamSim
