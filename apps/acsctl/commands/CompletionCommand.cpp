#include "commands/CompletionCommand.hpp"

#include "api/ApiCodec.hpp"
#include "commands/Answers.hpp"
#include "commands/Session.hpp"
#include "completion/Completion.hpp"
#include "config/ContextStore.hpp"
#include <acs/core/Result.hpp>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <optional>
#include <utility>

namespace ACS::Acsctl
{

namespace
{

constexpr std::chrono::milliseconds COMPLETION_TIMEOUT{2'000};

template <typename T>
std::optional<T> AskOrNull(IApi& api, const std::string& target)
{
    const Outcome<std::string> body = Get(api, target);
    if (!body.has_value())
    {
        return std::nullopt;
    }
    Core::Result<T> answer = DecodeAnswer<T>(*body);
    return answer.has_value() ? std::optional<T>(std::move(*answer)) : std::nullopt;
}

void AddPlans(IApi& api, std::vector<std::string>& out)
{
    for (PlanInfo& plan : AskOrNull<PlansAnswer>(api, "/v1/plans?limit=1000").value_or(PlansAnswer()).plans)
    {
        out.push_back(std::move(plan.planID));
    }
}

void AddRobots(IApi& api, std::vector<std::string>& out)
{
    for (RobotInfo& robot : AskOrNull<RobotsAnswer>(api, "/v1/robots").value_or(RobotsAnswer()).robots)
    {
        out.push_back(std::move(robot.robotID));
    }
}

void AddOfPlan(IApi& api, const std::string& planID, bool bJobs, std::vector<std::string>& out)
{
    for (StepInfo& step : AskOrNull<PlanInfo>(api, "/v1/plans/" + EncodePercent(planID)).value_or(PlanInfo()).steps)
    {
        if (!bJobs)
        {
            out.push_back(std::to_string(step.stepNo));
            continue;
        }
        for (JobInfo& job : step.jobs)
        {
            out.push_back(std::move(job.jobID));
        }
    }
}

void AddAlarms(IApi& api, const std::string& robotID, std::vector<std::string>& out)
{
    for (AlarmInfo& alarm : AskOrNull<AlarmsAnswer>(api, "/v1/alarms").value_or(AlarmsAnswer()).alarms)
    {
        if (alarm.robotID == robotID)
        {
            out.push_back(std::move(alarm.errorCode));
        }
    }
}

void AddActions(IApi& api, const std::string& robotID, std::vector<std::string>& out)
{
    const std::string target = "/v1/robots/" + EncodePercent(robotID) + "/actions";
    for (ActionOfferInfo& offer : AskOrNull<ActionsAnswer>(api, target).value_or(ActionsAnswer()).offered)
    {
        out.push_back(std::move(offer.actionType));
    }
}

void AddPlaces(IApi& api, const std::string& kind, std::vector<std::string>& out)
{
    SiteAnswer site = AskOrNull<SiteAnswer>(api, "/v1/site").value_or(SiteAnswer());
    if (kind == "node")
    {
        for (NodeInfo& node : site.nodes)
        {
            out.push_back(std::move(node.nodeID));
        }
    }
    else if (kind == "edge")
    {
        for (EdgeInfo& edge : site.edges)
        {
            out.push_back(std::move(edge.edgeID));
        }
    }
    else
    {
        for (StationInfo& station : site.stations)
        {
            out.push_back(std::move(station.stationID));
        }
    }
}

void AddContexts(const Environment& environment, std::vector<std::string>& out)
{
    for (const auto& [name, context] : ContextStore(environment).Load().value_or(Contexts()).entries)
    {
        out.push_back(name);
    }
}

void AddNames(IApi& api, const CompletionNeed& need, std::vector<std::string>& out)
{
    switch (need.source)
    {
        case ECompletionSource::Plans:
            AddPlans(api, out);
            break;
        case ECompletionSource::Robots:
            AddRobots(api, out);
            break;
        case ECompletionSource::PlansAndRobots:
            AddPlans(api, out);
            AddRobots(api, out);
            break;
        case ECompletionSource::Jobs:
        case ECompletionSource::Steps:
            AddOfPlan(api, need.subject, need.source == ECompletionSource::Jobs, out);
            break;
        case ECompletionSource::Alarms:
            AddAlarms(api, need.subject, out);
            break;
        case ECompletionSource::Actions:
            AddActions(api, need.subject, out);
            break;
        case ECompletionSource::Places:
            AddPlaces(api, need.subject, out);
            break;
        case ECompletionSource::None:
        case ECompletionSource::Contexts:
        case ECompletionSource::Files:
        default:
            break;
    }
}

bool NeedsAPI(ECompletionSource source)
{
    return source != ECompletionSource::None && source != ECompletionSource::Contexts
        && source != ECompletionSource::Files;
}

} // namespace

std::string RunCompletion(const std::vector<std::string>& words, const Environment& environment)
{
    CompletionNeed need = FindCompletion(words);
    std::vector<std::string> names;
    if (need.source == ECompletionSource::Contexts)
    {
        AddContexts(environment, names);
    }
    if (NeedsAPI(need.source))
    {
        AcsctlOptions options;
        options.connection = ReadConnectionOptions(words);
        options.timeout = COMPLETION_TIMEOUT;
        Session session;
        if (session.Open(options, environment).has_value())
        {
            AddNames(session.GetAPI(), need, names);
        }
    }
    if (need.bBeforeDashes)
    {
        ReplaceDashedNames(names);
    }
    std::vector<std::string> candidates = std::move(need.words);
    std::ranges::move(names, std::back_inserter(candidates));
    for (std::string& candidate : candidates)
    {
        candidate.insert(0, need.prefix);
    }
    std::string out;
    for (const std::string& candidate :
         SelectCandidates(std::move(candidates), words.empty() ? std::string() : words.back()))
    {
        out.append(candidate).append("\n");
    }
    return out;
}

} // namespace ACS::Acsctl
