#pragma once

#include "common/http/HttpLimits.hpp"
#include "common/http/HttpMessage.hpp"
#include <acs/core/Result.hpp>

#include <boost/beast/http/message.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/system/error_code.hpp>

#include <optional>
#include <string>

namespace ACS::Apps
{

using BeastRequest = boost::beast::http::request<boost::beast::http::string_body>;
using BeastResponse = boost::beast::http::response<boost::beast::http::string_body>;

/// An answer of the server itself, with the reason as its body.
[[nodiscard]] HttpResponse MakeHttpRefusal(boost::beast::http::status status, std::string reason);

/// The response to a request that Beast could not read; nullopt if the peer disconnected or the time limit expired.
[[nodiscard]] std::optional<HttpResponse> MakeHttpRefusalOrNull(
    const boost::system::error_code& error,
    const HttpLimits& limits);

/// The response to a header with which this server and a program in front of it could disagree about the end of the request or its
/// host (RFC 9112 sections 3.2 and 6.1); nullopt if it is valid. The connection must be closed after it.
[[nodiscard]] std::optional<HttpResponse> MakeHeaderRefusalOrNull(const BeastRequest& message);

/// Without the sender. Fails if the target is invalid.
[[nodiscard]] Core::Result<HttpRequest> MakeHttpRequest(const BeastRequest& message);

/// With the header of a body that ends with the connection if the response has a stream.
[[nodiscard]] BeastResponse MakeBeastResponse(const HttpResponse& response, bool bKeepAlive);

} // namespace ACS::Apps
