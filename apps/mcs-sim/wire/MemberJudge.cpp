#include "wire/MemberJudge.hpp"

#include <acs/json/JsonDocument.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace ACS::McsSim
{

namespace
{

using Names = std::vector<std::string_view>;

/// Members of a payload that must be there, with null where nothing applies, and that the codec does not need.
struct PayloadRule
{
    std::string_view command;
    Names members;
    Names entryMembers; ///< Of each element of the first member.
};

const std::vector<PayloadRule>& GetPayloadRules()
{
    static const Names ENTRY{"robotId", "jobId", "currentAction", "startTime", "endTime"};
    static const std::vector<PayloadRule> RULES{
        {"PlanReport", {"message"}, {}},
        {"StepReport", {"message"}, {}},
        {"JobReport", {"message"}, {}},
        {"CancelResultReport", {"message"}, {}},
        {"AbortResultReport", {"message"}, {}},
        {"PauseResultReport", {"message"}, {}},
        {"ResumeResultReport", {"message"}, {}},
        {"ErrorReport", {"message"}, {}},
        {"RobotStatusUpdate", {"position", "carrierIds", "planId", "stepNo", "jobId", "message"}, {}},
        {"ExecutionPlanAck", {"planId"}, {}},
        {"CancelPlanAck", {"planId"}, {}},
        {"AbortPlanAck", {"planId"}, {}},
        {"PausePlanAck", {"planId"}, {}},
        {"ResumePlanAck", {"planId"}, {}},
        {"RequestAcsPlansAck", {"plans"}, ENTRY},
        {"RequestAcsPlanHistoryAck", {"plans"}, ENTRY},
        {"RequestAcsErrorListAck", {"errors"}, {"message"}},
        {"SyncConfigAck", {}, {}}};
    return RULES;
}

bool HasMember(const Json::Value& object, std::string_view name)
{
    return object.HasMember(Json::Value::StringRefType(name.data(), static_cast<unsigned>(name.size())));
}

void AddMissing(const Json::Value& object, const Names& members, std::string_view path, std::vector<std::string>& out)
{
    for (const std::string_view name : members)
    {
        if (!HasMember(object, name))
        {
            out.push_back(fmt::format("{}{}", path, name));
        }
    }
}

void AddMissingOfPayload(const PayloadRule& rule, const Json::Value& payload, std::vector<std::string>& out)
{
    AddMissing(payload, rule.members, "payload.", out);
    if (rule.entryMembers.empty())
    {
        return;
    }
    const std::string list(rule.members.front());
    const auto found = payload.FindMember(list.c_str());
    if (found == payload.MemberEnd() || !found->value.IsArray())
    {
        return;
    }
    for (const Json::Value& element : found->value.GetArray())
    {
        if (element.IsObject())
        {
            AddMissing(element, rule.entryMembers, fmt::format("payload.{}[].", list), out);
        }
    }
}

std::string_view GetString(const Json::Value& object, const char* name)
{
    return object.HasMember(name) && object[name].IsString()
        ? std::string_view(object[name].GetString(), object[name].GetStringLength())
        : std::string_view();
}

} // namespace

std::vector<std::string> MemberJudge::OnText(std::string_view text)
{
    Json::JsonDocument document;
    const Core::Result<const Json::Value*> value = document.Parse(text, {});
    if (!value.has_value() || !(*value)->IsObject())
    {
        return {}; // The codec notes it.
    }
    const Json::Value& message = **value;
    const std::string_view command = GetString(message, "command");
    const std::vector<PayloadRule>& rules = GetPayloadRules();
    const auto rule = std::ranges::find(rules, command, &PayloadRule::command);
    if (rule == rules.end())
    {
        return {};
    }
    std::vector<std::string> missing;
    if (command.ends_with("Ack"))
    {
        AddMissing(message, {"result", "message", "payload"}, "", missing);
    }
    // A refusal may be unable to state what it refuses.
    const bool bRefusal = command.ends_with("Ack") && GetString(message, "result") != "Success";
    if (!bRefusal && message.HasMember("payload") && message["payload"].IsObject())
    {
        AddMissingOfPayload(*rule, message["payload"], missing);
    }
    _count += missing.size();
    std::vector<std::string> lines;
    for (const std::string& name : missing)
    {
        if (std::string member = fmt::format("{} {}", command, name); _reported.insert(member).second)
        {
            lines.push_back(fmt::format("ACS required member left out: {} (reported once)", member));
        }
    }
    return lines;
}

std::uint64_t MemberJudge::GetCount() const noexcept
{
    return _count;
}

} // namespace ACS::McsSim
