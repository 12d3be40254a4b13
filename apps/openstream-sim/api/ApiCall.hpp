#pragma once

#include <acs/openstream/ApiRequest.hpp>

#include <string>
#include <string_view>

namespace ACS::OpenStreamSim
{

class ControllerMachine;

/// One call of an endpoint.
struct ApiCall
{
    const OpenStream::ApiRequest& request;
    std::string_view argument; ///< The text at the pattern's {}.
    std::string& room;         ///< An empty buffer for answers that are read hundreds of times a second.
};

/// Answers one call; the machine has been advanced to the present.
using ApiHandler = OpenStream::ApiResponse (*)(ControllerMachine& machine, const ApiCall& call);

} // namespace ACS::OpenStreamSim
