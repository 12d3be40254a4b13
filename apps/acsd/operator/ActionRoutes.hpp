#pragma once

#include "common/http/HttpRoutes.hpp"
#include "view/RobotActionsView.hpp"
#include <acs/acsd/RobotAction.hpp>

#include <tl/expected.hpp>

#include <functional>
#include <optional>
#include <string>

namespace ACS::Acsd
{

/// What the routes of instant actions need.
struct ActionAccess
{
    /// The id of the action, or why it is not sent.
    using Requested = tl::expected<std::string, RobotActionRefusal>;

    std::function<bool()> isStopping;
    /// nullopt: there is no such robot; likewise below.
    std::function<std::optional<RobotActionsView>(const std::string& robotID)> listOrNull;
    std::function<std::optional<Requested>(const std::string& robotID, RobotActionRequest request, std::string reason)>
        requestOrNull;
};

/// GET and POST /v1/robots/ID/actions (docs/reference/http.md#instant-actions). POST: 202 with the id of the action; 400: the action is
/// unknown, not for operators, or its parameters are invalid; 404: there is no such robot; 409: the robot cannot be sent an action now;
/// 503: acsd stops.
void AddActionRoutes(Apps::HttpRoutes& routes, const ActionAccess& access);

} // namespace ACS::Acsd
