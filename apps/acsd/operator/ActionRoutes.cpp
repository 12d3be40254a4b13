#include "operator/ActionRoutes.hpp"

#include "operator/CommandBodies.hpp"
#include "operator/OperatorAnswer.hpp"
#include "view/ActionCodec.hpp"
#include <acs/core/Result.hpp>
#include <acs/json/JsonWriter.hpp>

#include <fmt/format.h>

#include <utility>

namespace ACS::Acsd
{

namespace
{

Apps::HttpResponse AcceptAction(const std::string& robotID, const std::string& actionType, const std::string& actionID)
{
    Apps::HttpResponse response{OperatorCode::ACCEPTED, "application/json", {}};
    Json::JsonWriter writer(response.body);
    writer.BeginObject();
    writer.Key("message");
    writer.WriteString(
        fmt::format("{} is sent to {}; /v1/robots/{}/actions shows its outcome.", actionType, robotID, robotID));
    writer.Key("actionId");
    writer.WriteString(actionID);
    writer.EndObject();
    response.body += '\n';
    return response;
}

Apps::HttpResponse RequestAction(
    const ActionAccess& access,
    const std::string& robotID,
    const Apps::HttpRequest& request)
{
    if (const std::optional<std::string> reason = FindUnexpectedParameterOrNull(request, {}))
    {
        return MakeOperatorError(OperatorCode::BAD_REQUEST, *reason);
    }
    Core::Result<ActionBody> body = ReadBody<ActionBody>(request.body);
    if (!body.has_value())
    {
        return MakeOperatorError(OperatorCode::BAD_REQUEST, "Invalid body: " + Core::Describe(body.error()));
    }
    if (access.isStopping())
    {
        return MakeOperatorError(OperatorCode::UNAVAILABLE, "acsd is stopping and accepts no requests.");
    }
    const std::string actionType = body->actionType;
    const std::optional<ActionAccess::Requested> requested = access.requestOrNull(
        robotID,
        {std::move(body->actionType), std::move(body->parameters.values)},
        std::move(body->reason));
    if (!requested.has_value())
    {
        return RefuseUnknown("robot", robotID);
    }
    if (!requested->has_value())
    {
        const RobotActionRefusal& refusal = requested->error();
        return MakeOperatorError(
            refusal.bInvalid ? OperatorCode::BAD_REQUEST : OperatorCode::CONFLICT,
            refusal.sentence);
    }
    return AcceptAction(robotID, actionType, **requested);
}

} // namespace

void AddActionRoutes(Apps::HttpRoutes& routes, const ActionAccess& access)
{
    constexpr std::string_view PATTERN = "/v1/robots/{robotId}/actions";
    routes.Add("GET", PATTERN, [access](const Apps::HttpRequest& request, const auto& captures) {
        if (const std::optional<std::string> reason = FindUnexpectedParameterOrNull(request, {}))
        {
            return MakeOperatorError(OperatorCode::BAD_REQUEST, *reason);
        }
        const std::optional<RobotActionsView> view = access.listOrNull(captures[0]);
        return view.has_value() ? MakeJsonAnswer(EncodeActions(*view)) : RefuseUnknown("robot", captures[0]);
    });
    routes.Add("POST", PATTERN, [access](const Apps::HttpRequest& request, const auto& captures) {
        return RequestAction(access, captures[0], request);
    });
}

} // namespace ACS::Acsd
