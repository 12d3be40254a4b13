#include "view/ViewCodec.hpp"

#include "view/ViewFields.hpp"
#include <acs/plan/EPlanState.hpp>

#include <algorithm>
#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>

namespace ACS::Acsd
{

namespace
{

template <typename TWrite>
std::string EncodeObject(TWrite write)
{
    std::string text;
    Json::JsonWriter writer(text);
    writer.BeginObject();
    write(writer);
    writer.EndObject();
    return text;
}

template <typename TValue>
void WriteMember(Json::JsonWriter& writer, std::string_view key, const TValue& value)
{
    writer.Key(key);
    Json::Encode(value, writer);
}

/// {"robots":[…]}
template <typename TItem>
std::string EncodeList(std::string_view key, const std::vector<TItem>& items)
{
    return EncodeObject([&](Json::JsonWriter& writer) { WriteMember(writer, key, items); }) + '\n';
}

template <typename TItem>
std::string EncodeItem(const TItem& item)
{
    std::string text;
    Json::JsonWriter writer(text);
    Json::Encode(item, writer);
    text += '\n';
    return text;
}

/// The age is in the answers only: in the events it would be a change by itself.
void WriteStatus(Json::JsonWriter& writer, const StatusView& status, Core::WallTime now)
{
    Json::EncodeMembers(status, writer);
    // Negative if the wall clock was set back.
    const auto uptime = std::chrono::duration_cast<std::chrono::seconds>(now - status.startedAt);
    WriteMember(writer, "uptimeSeconds", std::max<std::int64_t>(uptime.count(), 0));
}

} // namespace

std::string EncodeStatus(const StatusView& status, Core::WallTime now)
{
    return EncodeObject([&](Json::JsonWriter& writer) { WriteStatus(writer, status, now); }) + '\n';
}

std::string EncodeSnapshot(const StateView& state, std::uint64_t eventID, Core::WallTime now)
{
    return EncodeObject([&](Json::JsonWriter& writer) {
               WriteMember(writer, "eventId", eventID);
               writer.Key("status");
               writer.BeginObject();
               WriteStatus(writer, state.status, now);
               writer.EndObject();
               WriteMember(writer, "plans", state.plans);
               WriteMember(writer, "robots", state.robots);
               WriteMember(writer, "alarms", state.alarms);
           })
        + '\n';
}

std::string EncodePlans(const std::vector<PlanView>& plans)
{
    return EncodeList("plans", plans);
}

std::string EncodePlan(const PlanView& plan)
{
    return EncodeItem(plan);
}

std::string EncodeQueue(const StateView& state)
{
    return EncodeObject([&](Json::JsonWriter& writer) {
               writer.Key("plans");
               writer.BeginArray();
               std::int64_t position = 0;
               for (const PlanView& plan : state.plans)
               {
                   const bool bHeld = plan.status == GetText(Planning::EPlanState::Paused);
                   if (!plan.robotID.has_value() && !bHeld)
                   {
                       writer.BeginObject();
                       WriteMember(writer, "position", ++position);
                       WriteMember(writer, "planId", plan.planID);
                       WriteMember(writer, "priority", plan.priority);
                       WriteMember(writer, "acceptedAt", plan.acceptedAt);
                       WriteMember(writer, "waits", plan.waits);
                       writer.EndObject();
                   }
               }
               writer.EndArray();
               WriteMember(writer, "outbox", state.status.outbox);
           })
        + '\n';
}

std::string EncodeRobots(const std::vector<RobotView>& robots)
{
    return EncodeList("robots", robots);
}

std::string EncodeRobot(const RobotView& robot)
{
    return EncodeItem(robot);
}

std::string EncodeAlarms(const std::vector<AlarmView>& alarms)
{
    return EncodeList("alarms", alarms);
}

std::string EncodeLinks(const std::vector<LinkView>& links)
{
    return EncodeList("links", links);
}

std::string EncodeSite(const SiteView& site)
{
    return EncodeItem(site);
}

std::string EncodeChanges(const StateChanges& changes, const std::vector<PlanView>& endedPlans)
{
    return EncodeObject([&](Json::JsonWriter& writer) {
        if (changes.status.has_value())
        {
            WriteMember(writer, "status", *changes.status);
        }
        if (!changes.plans.empty())
        {
            WriteMember(writer, "plans", changes.plans);
        }
        if (!endedPlans.empty())
        {
            WriteMember(writer, "ended", endedPlans);
        }
        if (!changes.robots.empty())
        {
            WriteMember(writer, "robots", changes.robots);
        }
        if (changes.alarms.has_value())
        {
            WriteMember(writer, "alarms", *changes.alarms);
        }
    });
}

std::string EncodeEntry(const ChangeEntry& entry, Core::WallTime time)
{
    const auto makeTextOrNull = [](std::string_view text) {
        return text.empty() ? std::nullopt : std::optional<std::string>(text);
    };
    return EncodeObject([&](Json::JsonWriter& writer) {
        WriteMember(writer, "time", time);
        WriteMember(writer, "kind", std::string(entry.kind));
        WriteMember(writer, "robotId", makeTextOrNull(entry.robotID));
        WriteMember(writer, "planId", makeTextOrNull(entry.planID));
        WriteMember(writer, "stepNo", entry.stepNo == 0 ? std::nullopt : std::optional(entry.stepNo));
        WriteMember(writer, "jobId", makeTextOrNull(entry.jobID));
        WriteMember(writer, "text", std::string(entry.text));
    });
}

} // namespace ACS::Acsd
