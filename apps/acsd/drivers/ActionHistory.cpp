#include "drivers/ActionHistory.hpp"

#include <acs/core/ShortText.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

namespace ACS::Acsd
{

bool ActionHistory::HasRoom() const
{
    return _records.size() < MOST_RECORDS
        || std::ranges::any_of(_records, [](const RobotActionRecord& record) { return IsEnded(record.status); });
}

const RobotActionRecord& ActionHistory::Add(RobotActionRecord record)
{
    assert(HasRoom());
    if (_records.size() >= MOST_RECORDS)
    {
        _records.erase(
            std::ranges::find_if(_records, [](const RobotActionRecord& known) { return IsEnded(known.status); }));
    }
    return _records.emplace_back(std::move(record));
}

const RobotActionRecord* ActionHistory::ApplyOrNull(const RobotActionChange& change, Core::WallTime now)
{
    const auto record = std::ranges::find(_records, change.actionID, &RobotActionRecord::actionID);
    std::string result = Core::ShortenText(change.resultDescription, MOST_RESULT_BYTES);
    if (record == _records.end() || (record->status == change.status && record->resultDescription == result))
    {
        return nullptr;
    }
    if (record->status != change.status)
    {
        record->endedAt = IsEnded(change.status) ? std::optional(now) : std::nullopt;
    }
    record->status = change.status;
    record->resultDescription = std::move(result);
    return &*record;
}

const std::vector<RobotActionRecord>& ActionHistory::GetRecords() const noexcept
{
    return _records;
}

std::string_view GetText(ERobotActionStatus status)
{
    switch (status)
    {
        case ERobotActionStatus::Initializing:
            return "Initializing";
        case ERobotActionStatus::Running:
            return "Running";
        case ERobotActionStatus::Paused:
            return "Paused";
        case ERobotActionStatus::Finished:
            return "Finished";
        case ERobotActionStatus::Failed:
            return "Failed";
        case ERobotActionStatus::Unknown:
            return "Unknown";
        case ERobotActionStatus::Waiting:
        default:
            return "Waiting";
    }
}

std::string DescribeAction(const std::string& robotID, const RobotActionRecord& record)
{
    const bool bEnded = IsEnded(record.status);
    const std::string detail = Core::ShortenText(bEnded ? record.resultDescription : record.reason);
    return fmt::format(
        "action {} of {}: {}{}",
        record.actionType,
        robotID,
        bEnded ? GetText(record.status) : "requested",
        detail.empty() ? std::string() : ": " + detail);
}

} // namespace ACS::Acsd
