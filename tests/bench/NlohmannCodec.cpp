#include "NlohmannCodec.hpp"

#include <cstdint>
#include <stdexcept>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

namespace ACS::Bench
{

namespace
{

using Json = nlohmann::ordered_json;

std::string GetText(const Json& object, const char* name)
{
    const auto found = object.find(name);
    return found == object.end() || found->is_null() ? std::string() : found->get<std::string>();
}

Protocol::PlanStep ReadStep(const Json& object)
{
    Protocol::PlanStep step;
    object.at("stepNo").get_to(step.stepNo);
    object.at("action").get_to(step.action);
    object.at("position").get_to(step.position);
    object.at("carrierIds").get_to(step.carrierIDs);
    for (const Json& job : object.at("jobs"))
    {
        step.jobs.push_back({job.at("jobId").get<std::string>(), GetText(job, "from"), GetText(job, "to")});
    }
    return step;
}

Protocol::ExecutionPlan ReadPlan(const Json& object)
{
    Protocol::ExecutionPlan plan;
    object.at("planId").get_to(plan.planID);
    plan.lotID = GetText(object, "lotId");
    if (object.contains("priority"))
    {
        plan.priority = object.at("priority").get<std::int32_t>();
    }
    for (const Json& step : object.at("steps"))
    {
        plan.steps.push_back(ReadStep(step));
    }
    return plan;
}

Protocol::RobotPositionUpdate ReadPositions(const Json& object)
{
    Protocol::RobotPositionUpdate update;
    for (const Json& robot : object.at("robots"))
    {
        update.robots.push_back(
            {robot.at("robotId").get<std::string>(),
             robot.at("x").get<double>(),
             robot.at("y").get<double>(),
             robot.at("angle").get<double>(),
             robot.at("battery").get<double>()});
    }
    return update;
}

Json WritePlan(const Protocol::ExecutionPlan& plan)
{
    Json steps = Json::array();
    for (const Protocol::PlanStep& step : plan.steps)
    {
        Json jobs = Json::array();
        for (const Protocol::PlanJob& job : step.jobs)
        {
            jobs.push_back({{"jobId", job.jobID}, {"from", job.from}, {"to", job.to}});
        }
        steps.push_back(
            {{"stepNo", step.stepNo},
             {"action", step.action},
             {"position", step.position},
             {"carrierIds", step.carrierIDs},
             {"jobs", std::move(jobs)}});
    }
    Json object{{"planId", plan.planID}, {"lotId", plan.lotID}};
    if (plan.priority.has_value())
    {
        object["priority"] = *plan.priority;
    }
    object["steps"] = std::move(steps);
    return object;
}

Json WritePositions(const Protocol::RobotPositionUpdate& update)
{
    Json robots = Json::array();
    for (const Protocol::RobotPosition& robot : update.robots)
    {
        robots.push_back(
            {{"robotId", robot.robotID},
             {"x", robot.x},
             {"y", robot.y},
             {"angle", robot.angle},
             {"battery", robot.battery}});
    }
    return {{"robots", std::move(robots)}};
}

} // namespace

Protocol::AcsRequest NlohmannCodec::Decode(std::string_view text)
{
    const Json root = Json::parse(text);
    Protocol::AcsRequest request;
    root.at("transactionId").get_to(request.transactionID);
    request.timestamp = Core::ParseTimestamp(root.at("timestamp").get<std::string>()).value();
    const std::string command = root.at("command").get<std::string>();
    if (command == "ExecutionPlan")
    {
        request.payload = ReadPlan(root.at("payload"));
    }
    else if (command == "RobotPositionUpdate")
    {
        request.payload = ReadPositions(root.at("payload"));
    }
    else
    {
        throw std::invalid_argument("no message of this benchmark: " + command);
    }
    return request;
}

std::string NlohmannCodec::Encode(const Protocol::AcsRequest& request)
{
    const Protocol::ExecutionPlan* planOrNull = std::get_if<Protocol::ExecutionPlan>(&request.payload);
    const Json root{
        {"command", GetText(GetCommand(request))},
        {"transactionId", request.transactionID},
        {"timestamp", Core::FormatLocal(request.timestamp.time, request.timestamp.offset)},
        {"payload",
         planOrNull != nullptr ? WritePlan(*planOrNull)
                               : WritePositions(std::get<Protocol::RobotPositionUpdate>(request.payload))}};
    return root.dump();
}

} // namespace ACS::Bench
