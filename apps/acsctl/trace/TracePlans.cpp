#include "trace/TracePlans.hpp"

#include "common/trace/TraceLine.hpp"

namespace ACS::Acsctl
{

std::string TracePlans::FindPlan(std::string_view line)
{
    const std::string_view members = line.substr(0, line.find(R"(,"text":)")); // a text may have anything
    const std::string_view robot = Apps::FindTextMember(members, "robot");
    const std::string_view plan = Apps::FindTextMember(members, "plan");
    const bool bOfMCS = Apps::FindTextMember(members, "link") == "mcs"; // states its own plan
    if (!plan.empty() || robot.empty() || bOfMCS)
    {
        if (!plan.empty() && !robot.empty() && !bOfMCS)
        {
            _plans.insert_or_assign(std::string(robot), std::string(plan));
        }
        return std::string(plan);
    }
    if (!Apps::FindTextMember(members, "program").empty())
    {
        const auto found = _plans.find(robot);
        return found == _plans.end() ? std::string() : found->second;
    }
    if (Apps::FindTextMember(members, "kind").empty())
    {
        // A message of a robot that has no plan.
        if (const auto found = _plans.find(robot); found != _plans.end())
        {
            _plans.erase(found);
        }
    }
    return {};
}

} // namespace ACS::Acsctl
