#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Now.hpp>
#include <acs/openstream/ApiRequest.hpp>

namespace ACS::OpenStream
{

/// The controller's Open API, for both the Open Stream and HTTP. Called on the thread of the server; must not throw, and
/// should answer within a fraction of the shortest period in use.
class ACS_API IOpenApiService
{
public:
    IOpenApiService() = default;
    IOpenApiService(const IOpenApiService&) = delete;
    IOpenApiService& operator=(const IOpenApiService&) = delete;
    virtual ~IOpenApiService() = default;

    /// Called with any method and path: 404 for an unknown one. A status of 500 or more is a failure of the service. Must
    /// set all of the response, which contains that of an earlier call: a service with a short period writes into
    /// ApiResponse::TakeRoom, which needs no allocation; others assign a new ApiResponse.
    virtual void Call(const ApiRequest& request, Core::Now now, ApiResponse& response) = 0;

    /// A client sent STOP control: discard buffered data such as the points of a trajectory, also those of a lost connection
    /// or of HTTP, and stop their motion. Called for a client that has sent no CONTROL as well, but not while another session
    /// controls the robot (ServerSession::HasControl).
    virtual void StopControl(Core::Now now) = 0;
};

} // namespace ACS::OpenStream
