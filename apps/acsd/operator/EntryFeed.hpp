#pragma once

#include <acs/core/Now.hpp>
#include <acs/plan/IPlanObserver.hpp>

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// Makes an event `entry` of the operator API of each change of state, as one line for people, and passes the change to the next
/// observer.
class EntryFeed final : public Planning::IPlanObserver
{
public:
    /// Receives the data of an event `entry`.
    using Publisher = std::function<void(std::string_view data)>;

    /// Kind, objects and text of an entry; empty members are null.
    struct Entry
    {
        std::string_view kind;
        std::string_view robotID;
        std::string_view planID;
        std::int32_t stepNo = 0; ///< 0: none.
        std::string_view jobID;
        std::string_view text;
    };

private:
    Publisher _publish;
    Planning::IPlanObserver& _next;

public:
    /// The next observer must outlive the feed.
    EntryFeed(Publisher publish, Planning::IPlanObserver& next);

    /// An entry that is not of the engine: of a link or a command.
    void Publish(const Entry& entry, Core::WallTime time);

    void OnPlanChanged(
        const Planning::PlanRecord& record,
        Planning::EPlanState from,
        std::string_view transactionID,
        Core::Now now) override;
    void OnStepChanged(
        const Planning::PlanRecord& record,
        std::size_t stepIndex,
        Planning::EStepState from,
        std::string_view transactionID,
        Core::Now now) override;
    void OnJobChanged(
        const Planning::PlanRecord& record,
        std::size_t stepIndex,
        std::size_t jobIndex,
        Planning::EJobState from,
        std::string_view transactionID,
        Core::Now now) override;
    void OnAlarmChanged(const Planning::Alarm& alarm, bool bSet, std::string_view transactionID, Core::Now now)
        override;
    void OnRobotStatusChanged(const Planning::RobotStatus& status, Core::Now now) override;
    void OnTscChanged(Planning::ETscState state, Planning::ETscState from, Core::Now now) override;
    void OnNote(std::string_view robotID, std::string_view text, Core::Now now) override;
};

} // namespace ACS::Acsd
