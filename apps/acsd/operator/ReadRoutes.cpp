#include "operator/ReadRoutes.hpp"

#include "operator/OperatorAnswer.hpp"
#include "operator/PlanFilter.hpp"
#include "view/PlanViewMaker.hpp"
#include "view/SiteViewMaker.hpp"
#include "view/ViewCodec.hpp"
#include <acs/core/Result.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

namespace
{

using Apps::HttpRequest;
using Apps::HttpResponse;
using Captures = Apps::HttpRoutes::Captures;

/// Adds a GET without parameters.
template <typename THandle>
void AddRead(Apps::HttpRoutes& routes, std::string_view pattern, THandle handle)
{
    routes.Add(
        "GET",
        pattern,
        [handle = std::move(handle)](const HttpRequest& request, const Captures& captures) -> HttpResponse {
            const std::optional<std::string> reason = FindUnexpectedParameterOrNull(request, {});
            return reason.has_value() ? MakeOperatorError(OperatorCode::BAD_REQUEST, *reason) : handle(captures);
        });
}

/// The robot and the wait reason are those of the present state, which notes the time of the latter.
HttpResponse ShowPlan(const Planning::PlanEngine& engine, const StateView& state, const std::string& planID)
{
    const Planning::PlanRecord* recordOrNull = engine.GetPlanRecordOrNull(planID);
    if (recordOrNull == nullptr)
    {
        return RefuseUnknown("plan", planID);
    }
    PlanView plan = MakePlanView(*recordOrNull, EPlanDetail::Jobs);
    if (const auto found = std::ranges::find(state.plans, planID, &PlanView::planID); found != state.plans.end())
    {
        plan.robotID = found->robotID;
        plan.waits = found->waits;
    }
    // The view of all plans lists the robots of the first plans in the queue only.
    const std::optional<Planning::WaitReason> reason =
        plan.waits.has_value() ? engine.GetWaitReasonOrNull(planID) : std::nullopt;
    if (reason.has_value())
    {
        plan.waits = MakeWaitView(*reason, plan.waits->since);
    }
    return MakeJsonAnswer(EncodePlan(plan));
}

HttpResponse ShowRobot(const StateView& state, const std::string& robotID)
{
    const auto found = std::ranges::find(state.robots, robotID, &RobotView::robotID);
    if (found == state.robots.end())
    {
        return RefuseUnknown("robot", robotID);
    }
    return MakeJsonAnswer(EncodeRobot(*found));
}

HttpResponse ShowPlans(const Planning::PlanEngine& engine, const StateView& state, const HttpRequest& request)
{
    if (const std::optional<std::string> reason =
            FindUnexpectedParameterOrNull(request, {"state", "robot", "lot", "limit"}))
    {
        return MakeOperatorError(OperatorCode::BAD_REQUEST, *reason);
    }
    const Core::Result<PlanFilter> filter = PlanFilter::Read(request);
    if (!filter.has_value())
    {
        return MakeOperatorError(OperatorCode::BAD_REQUEST, Core::Describe(filter.error()));
    }
    return MakeJsonAnswer(EncodePlans(filter->List(engine, state)));
}

} // namespace

void AddReadRoutes(Apps::HttpRoutes& routes, const Planning::PlanEngine& engine, const ReadAccess& access)
{
    AddRead(routes, "/v1/status", [access](const Captures&) {
        return MakeJsonAnswer(EncodeStatus(access.getState().status, access.clock.GetNow().wall));
    });
    AddRead(routes, "/v1/snapshot", [access](const Captures&) {
        const StateView& state = access.getPublished();
        return MakeJsonAnswer(EncodeSnapshot(state, access.getEventID(), access.clock.GetNow().wall));
    });
    routes.Add("GET", "/v1/plans", [&engine, access](const HttpRequest& request, const Captures&) {
        return ShowPlans(engine, access.getState(), request);
    });
    AddRead(routes, "/v1/plans/{planId}", [&engine, access](const Captures& captures) {
        return ShowPlan(engine, access.getState(), captures[0]);
    });
    AddRead(routes, "/v1/robots", [access](const Captures&) {
        return MakeJsonAnswer(EncodeRobots(access.getState().robots));
    });
    AddRead(routes, "/v1/robots/{robotId}", [access](const Captures& captures) {
        return ShowRobot(access.getState(), captures[0]);
    });
    AddRead(routes, "/v1/alarms", [access](const Captures&) {
        return MakeJsonAnswer(EncodeAlarms(access.getState().alarms));
    });
    AddRead(routes, "/v1/links", [access](const Captures&) {
        return MakeJsonAnswer(EncodeLinks(access.getState().status.links));
    });
    AddRead(routes, "/v1/queue", [access](const Captures&) { return MakeJsonAnswer(EncodeQueue(access.getState())); });
    const auto site = std::make_shared<SiteView>(MakeSiteView(engine.GetSite()));
    AddRead(routes, "/v1/site", [&engine, site](const Captures&) {
        site->blocked = MakeBlockViews(engine.GetBlocks());
        return MakeJsonAnswer(EncodeSite(*site));
    });
}

} // namespace ACS::Acsd
