#include "commands/WhyCommand.hpp"

#include "api/ApiCodec.hpp"
#include "why/ExplanationView.hpp"
#include "why/WhyExplainer.hpp"
#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <utility>

namespace ACS::Acsctl
{

namespace
{

template <typename T>
Outcome<T> GetDecoded(IApi& api, const std::string& target)
{
    const Outcome<std::string> body = Get(api, target);
    if (!body.has_value())
    {
        return tl::make_unexpected(body.error());
    }
    Core::Result<T> answer = DecodeAnswer<T>(*body);
    if (!answer.has_value())
    {
        return MakeBadAnswer(answer.error());
    }
    return std::move(*answer);
}

Outcome<Explanation> Explain(IApi& api, const WhyExplainer& explainer, const std::string& id)
{
    if (id.empty())
    {
        return explainer.ExplainAll();
    }
    if (const RobotInfo* const robotOrNull = explainer.FindRobotOrNull(id); robotOrNull != nullptr)
    {
        return explainer.ExplainRobot(*robotOrNull);
    }
    if (const PlanInfo* const planOrNull = explainer.FindPlanOrNull(id); planOrNull != nullptr)
    {
        return explainer.ExplainPlan(*planOrNull);
    }
    const Outcome<PlanInfo> plan = GetDecoded<PlanInfo>(api, "/v1/plans/" + EncodePercent(id));
    if (plan.has_value())
    {
        return explainer.ExplainPlan(*plan);
    }
    return plan.error().exitCode == EXIT_REFUSED
        ? FailWith(EXIT_REFUSED, fmt::format("there is no plan or robot {}", Core::QuoteForError(id)))
        : tl::make_unexpected(plan.error());
}

} // namespace

Outcome<Shown> RunWhy(IApi& api, const AcsctlOptions& options, const ViewContext& context)
{
    const Outcome<SnapshotAnswer> snapshot = GetDecoded<SnapshotAnswer>(api, "/v1/snapshot");
    if (!snapshot.has_value())
    {
        return tl::make_unexpected(snapshot.error());
    }
    const Outcome<SiteAnswer> site = GetDecoded<SiteAnswer>(api, "/v1/site");
    if (!site.has_value())
    {
        return tl::make_unexpected(site.error());
    }
    const WhyExplainer explainer(*snapshot, *site, GetServerTime(snapshot->status, context.now));
    const Outcome<Explanation> explanation = Explain(api, explainer, options.arguments.id);
    if (!explanation.has_value())
    {
        return tl::make_unexpected(explanation.error());
    }
    return Shown{
        options.bJSON ? MakeExplanationText(*explanation) + "\n" : PrintExplanation(*explanation, context.screen),
        explanation->NeedsAttention() ? EXIT_ATTENTION : EXIT_DONE};
}

} // namespace ACS::Acsctl
