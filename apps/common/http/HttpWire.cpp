#include "common/http/HttpWire.hpp"

#include <boost/beast/core/string.hpp>
#include <boost/beast/http/error.hpp>
#include <boost/beast/http/field.hpp>
#include <boost/beast/http/status.hpp>
#include <boost/none.hpp>

#include <cstddef>
#include <iterator>
#include <string_view>
#include <utility>

namespace ACS::Apps
{

namespace
{

namespace Http = boost::beast::http;

constexpr unsigned HTTP_VERSION = 11;

template <typename TView>
std::string MakeString(const TView& text)
{
    return std::string(text.data(), text.size());
}

std::size_t CountFields(const BeastRequest& message, Http::field name)
{
    const auto [first, last] = message.equal_range(name);
    return static_cast<std::size_t>(std::distance(first, last));
}

/// Responses of these never have a body.
bool IsWithoutBody(unsigned status)
{
    return status == static_cast<unsigned>(Http::status::no_content)
        || status == static_cast<unsigned>(Http::status::not_modified);
}

} // namespace

HttpResponse MakeHttpRefusal(Http::status status, std::string reason)
{
    HttpResponse response;
    response.status = static_cast<unsigned>(status);
    response.body = std::move(reason) + "\n";
    return response;
}

std::optional<HttpResponse> MakeHttpRefusalOrNull(const boost::system::error_code& error, const HttpLimits& limits)
{
    if (error == Http::error::body_limit)
    {
        return MakeHttpRefusal(
            Http::status::payload_too_large,
            "the body is longer than " + std::to_string(limits.maxBodyBytes) + " bytes");
    }
    if (error == Http::error::header_limit)
    {
        return MakeHttpRefusal(
            Http::status::request_header_fields_too_large,
            "the header is longer than " + std::to_string(limits.maxHeaderBytes) + " bytes");
    }
    const bool bHttpError = error.category() == Http::make_error_code(Http::error::bad_method).category();
    if (bHttpError && error != Http::error::end_of_stream && error != Http::error::partial_message)
    {
        return MakeHttpRefusal(Http::status::bad_request, "not an HTTP/1.1 request");
    }
    return std::nullopt;
}

std::optional<HttpResponse> MakeHeaderRefusalOrNull(const BeastRequest& message)
{
    const std::size_t hosts = CountFields(message, Http::field::host);
    if (hosts > 1 || (hosts == 0 && message.version() >= HTTP_VERSION))
    {
        return MakeHttpRefusal(Http::status::bad_request, "expected one Host");
    }
    const std::size_t codings = CountFields(message, Http::field::transfer_encoding);
    if (codings == 0)
    {
        return std::nullopt;
    }
    if (message.version() < HTTP_VERSION)
    {
        return MakeHttpRefusal(Http::status::bad_request, "Transfer-Encoding needs HTTP/1.1");
    }
    if (codings > 1 || !boost::beast::iequals(message[Http::field::transfer_encoding], "chunked"))
    {
        return MakeHttpRefusal(Http::status::not_implemented, "the only Transfer-Encoding is chunked");
    }
    return std::nullopt;
}

Core::Result<HttpRequest> MakeHttpRequest(const BeastRequest& message)
{
    const std::string_view target(message.target().data(), message.target().size());
    Core::Result<HttpRequest> request = ParseHttpTarget(target);
    if (!request.has_value())
    {
        return request;
    }
    request->method = MakeString(message.method_string());
    request->body = message.body();
    for (const auto& field : message)
    {
        request->headers.emplace_back(MakeString(field.name_string()), MakeString(field.value()));
    }
    return request;
}

BeastResponse MakeBeastResponse(const HttpResponse& response, bool bKeepAlive)
{
    BeastResponse message(Http::int_to_status(response.status), HTTP_VERSION);
    message.result(response.status);
    if (!response.contentType.empty())
    {
        message.set(Http::field::content_type, response.contentType);
    }
    if (!response.allow.empty())
    {
        message.set(Http::field::allow, response.allow);
    }
    if (response.retryAfter.count() > 0)
    {
        message.set(Http::field::retry_after, std::to_string(response.retryAfter.count()));
    }
    if (!response.challenge.empty())
    {
        message.set(Http::field::www_authenticate, response.challenge);
    }
    for (const auto& [name, value] : response.headers)
    {
        message.insert(name, value);
    }
    if (response.stream != nullptr)
    {
        message.keep_alive(false);
        return message;
    }
    message.keep_alive(bKeepAlive);
    if (IsWithoutBody(response.status))
    {
        return message;
    }
    message.body() = response.body;
    message.prepare_payload();
    return message;
}

} // namespace ACS::Apps
