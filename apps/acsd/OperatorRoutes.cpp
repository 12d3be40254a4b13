#include "OperatorRoutes.hpp"

#include <acs/json/JsonWriter.hpp>

#include <string>
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
    for (const auto& [word, answer] :
         {std::pair("done", Planning::EJobAnswer::Done),
          std::pair("failed", Planning::EJobAnswer::Failed),
          std::pair("again", Planning::EJobAnswer::Again)})
    {
        const Planning::EJobAnswer said = answer;
        routes.Add(
            "POST",
            std::string("/plans/{PLAN}/jobs/{JOB}/") + word,
            [handler, said](const HttpRequest&, const Captures& captures) {
                handler(Planning::SettleJob{captures[0], captures[1], said, 0});
                return Accept("The answer is taken; where the job was held, its alarm ACS-1008 is cleared in /status.");
            });
    }
}

} // namespace ACS::Acsd
