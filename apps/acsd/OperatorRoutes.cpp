#include "OperatorRoutes.hpp"

#include <acs/json/JsonWriter.hpp>

#include <string_view>
#include <utility>

namespace ACS::Acsd
{

namespace
{

using Apps::HttpRequest;
using Apps::HttpResponse;
using Captures = Apps::HttpRoutes::Captures;

constexpr unsigned HTTP_ACCEPTED = 202;

HttpResponse MakeAnswer(unsigned status, std::string_view key, std::string_view sentence)
{
    HttpResponse response{status, "application/json", {}};
    Json::JsonWriter writer(response.body);
    writer.BeginObject();
    writer.Key(key);
    writer.WriteString(sentence);
    writer.EndObject();
    response.body += '\n';
    return response;
}

HttpResponse Accept(std::string_view message)
{
    return MakeAnswer(HTTP_ACCEPTED, "message", message);
}

} // namespace

void AddOperatorRoutes(Apps::HttpRoutes& routes, OperatorHandler handler)
{
    routes.Add("POST", "/tsc/pause", [handler](const HttpRequest&, const Captures&) {
        handler(Planning::ControlTsc{true, 0});
        return Accept("The TSC is told to pause; /status has its state.");
    });
    routes.Add("POST", "/tsc/resume", [handler](const HttpRequest&, const Captures&) {
        handler(Planning::ControlTsc{false, 0});
        return Accept("The TSC is told to resume; /status has its state.");
    });
}

} // namespace ACS::Acsd
