#pragma once

#include "common/http/HttpMessage.hpp"

#include <functional>

namespace ACS::Apps
{

/// A response that is made after the handler has returned. Other connections are not delayed. Shared by its maker and the server;
/// used on the server's thread.
class HttpPendingResponse final
{
public:
    using Handler = std::function<void(const HttpResponse& response)>;

private:
    Handler _onComplete;

public:
    HttpPendingResponse() = default;
    HttpPendingResponse(const HttpPendingResponse&) = delete;
    HttpPendingResponse& operator=(const HttpPendingResponse&) = delete;
    ~HttpPendingResponse() = default;

    /// By the maker, once, in a later turn of the loop. Has no effect if the connection is gone. The response has neither a stream
    /// nor a delay.
    void Complete(const HttpResponse& response);

    /// By the server.
    void Attach(Handler onComplete);
};

} // namespace ACS::Apps
