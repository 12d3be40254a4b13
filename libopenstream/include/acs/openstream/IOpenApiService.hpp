#pragma once

#include <acs/core/Now.hpp>
#include <acs/openstream/ApiRequest.hpp>

namespace ACS::OpenStream
{

/// The controller behind the Open Stream and behind the HTTP side: one implementation serves both. Called on the thread
/// of the server, must not throw and should answer within a fraction of the shortest period that is used.
class IOpenApiService
{
public:
    IOpenApiService() = default;
    IOpenApiService(const IOpenApiService&) = delete;
    IOpenApiService& operator=(const IOpenApiService&) = delete;
    virtual ~IOpenApiService() = default;

    /// Any method and path: 404 for one that it does not have. A status of 500 or more says that the service itself
    /// failed. Sets all of the response, which holds what an earlier call left: a service that is asked at a short period
    /// writes into ApiResponse::TakeRoom and so takes nothing from the heap; others assign a new ApiResponse.
    virtual void Call(const ApiRequest& request, Core::Now now, ApiResponse& response) = 0;

    /// A client sent STOP control: what is buffered is released, such as the points of a trajectory.
    virtual void StopControl(Core::Now now) = 0;
};

} // namespace ACS::OpenStream
