#include "common/trace/TraceQuery.hpp"

#include <acs/core/JsonText.hpp>

#include <array>
#include <utility>

namespace ACS::Apps
{

namespace
{

bool HasMember(std::string_view line, std::string_view name, std::string_view value)
{
    if (value.empty())
    {
        return true;
    }
    std::string member = ",\"";
    member += name;
    member += "\":";
    Core::JsonText::AppendString(value, member);
    return line.find(member) != std::string_view::npos;
}

} // namespace

bool TraceQuery::IsEmpty() const noexcept
{
    return planID.empty() && robotID.empty() && transactionID.empty();
}

bool TraceQuery::IsMatch(std::string_view line) const
{
    const std::string_view members = line.substr(0, line.find(R"(,"text":)")); // a text may have anything
    return members.find(R"("link":"core")") == std::string_view::npos && HasMember(members, "plan", planID)
        && HasMember(members, "robot", robotID) && HasMember(members, "transaction", transactionID);
}

} // namespace ACS::Apps
