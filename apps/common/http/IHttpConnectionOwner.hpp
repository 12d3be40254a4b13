#pragma once

#include "common/http/HttpMessage.hpp"

#include <string_view>

namespace ACS::Apps
{

class HttpConnection;

/// The server, as its connections see it.
class IHttpConnectionOwner
{
public:
    IHttpConnectionOwner() = default;
    IHttpConnectionOwner(const IHttpConnectionOwner&) = delete;
    IHttpConnectionOwner& operator=(const IHttpConnectionOwner&) = delete;
    virtual ~IHttpConnectionOwner() = default;

    /// The connection waits for its peer from now on, so that it may be replaced.
    virtual void OnWaiting(const HttpConnection& connection) = 0;

    /// May destroy the server.
    [[nodiscard]] virtual HttpResponse Respond(HttpRequest& request, const HttpConnection& connection) = 0;

    /// Rate-limited by kind.
    virtual void LogRefusal(std::string_view kind, std::string_view reason) = 0;

    virtual void OnClosed(const HttpConnection& connection) = 0;
};

} // namespace ACS::Apps
