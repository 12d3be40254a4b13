#include "api/HttpBridge.hpp"

#include "api/ApiAnswers.hpp"

#include <array>
#include <optional>
#include <string_view>
#include <utility>

namespace ACS::OpenStreamSim
{

namespace
{

using enum OpenStream::EApiMethod;

constexpr std::array METHODS{Get, Post, Put, Delete};

std::optional<OpenStream::EApiMethod> ParseMethodOrNull(std::string_view text)
{
    // The server omits the body of the answer.
    if (text == "HEAD")
    {
        return Get;
    }
    for (const OpenStream::EApiMethod method : METHODS)
    {
        if (OpenStream::GetMethodText(method) == text)
        {
            return method;
        }
    }
    return std::nullopt;
}

/// The path with its percent signs encoded again: the server has decoded the path, and the service decodes %5B and %5D.
std::string MakePath(std::string_view decoded)
{
    std::string path;
    for (const char letter : decoded)
    {
        path += letter == '%' ? std::string_view("%25") : std::string_view(&letter, 1);
    }
    return path;
}

/// The body as JSON; nullopt for a GET.
Core::Result<std::optional<Core::JsonText>> ReadJSON(const Apps::HttpRequest& request, OpenStream::EApiMethod method)
{
    if (method == Get)
    {
        return std::nullopt;
    }
    if (request.body.empty())
    {
        return Core::JsonText::FromTrusted("{}");
    }
    Json::JsonDocument document;
    const Core::Result<const Json::Value*> root = document.Parse(request.body, Json::ParseLimits{});
    if (!root.has_value())
    {
        return tl::unexpected(root.error());
    }
    if (!(*root)->IsObject() && !(*root)->IsArray())
    {
        return Core::Fail(Core::ECoreError::WrongType, "body", "an object or an array", Json::ShortenForError(**root));
    }
    return Core::JsonText::FromTrusted(Json::WriteText(**root));
}

Apps::HttpResponse MakeHttpResponse(const OpenStream::ApiResponse& response)
{
    Apps::HttpResponse http;
    http.status = static_cast<unsigned>(response.status);
    http.contentType = "application/json; charset=utf-8";
    http.delay = response.delay;
    http.body = response.body.has_value() ? response.body->GetText() : std::string();
    return http;
}

} // namespace

Apps::HttpResponse AnswerHTTP(const Apps::HttpRequest& request, OpenStream::IOpenApiService& service, Core::Now now)
{
    const std::optional<OpenStream::EApiMethod> method = ParseMethodOrNull(request.method);
    if (!method.has_value())
    {
        return MakeHttpResponse(RefusePath("the Open API has GET, POST, PUT and DELETE"));
    }
    Core::Result<std::optional<Core::JsonText>> body = ReadJSON(request, *method);
    if (!body.has_value())
    {
        return MakeHttpResponse(Refuse(body.error()));
    }
    OpenStream::ApiRequest call;
    call.method = *method;
    call.path = MakePath(request.path);
    for (const auto& [name, value] : request.query)
    {
        call.query.push_back(OpenStream::QueryParameter{name, value});
    }
    call.body = std::move(*body);
    OpenStream::ApiResponse response;
    service.Call(call, now, response);
    return MakeHttpResponse(response);
}

} // namespace ACS::OpenStreamSim
