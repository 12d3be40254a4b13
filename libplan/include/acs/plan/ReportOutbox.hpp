#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/IRandom.hpp>
#include <acs/core/Now.hpp>
#include <acs/plan/Report.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

namespace ACS::Planning
{

/// The durable reports that the MCS has not acknowledged, oldest first.
class ACS_API ReportOutbox
{
    /// As Alarm::IsSameAs.
    using AlarmKey = std::tuple<std::string, std::string, std::optional<std::string>, std::optional<std::string>>;

    std::deque<OutboxEntry> _entries;
    std::map<AlarmKey, std::uint64_t> _latestAlarms; ///< The sequence of the latest report of each alarm.
    std::size_t _alarmCount = 0;
    std::uint64_t _lastSequence = 0;

public:
    /// Assigns the report its sequence number, transactionID and time. The reference is valid until the next call.
    const OutboxEntry& Add(Report report, Core::WallTime time, Core::IRandom& random);

    /// False if there is no entry of this number, for example because it was acknowledged twice.
    [[nodiscard]] bool TryRemove(std::uint64_t sequence);

    /// Replaces all entries by those that a store returned.
    void Restore(std::vector<OutboxEntry> entries, std::uint64_t lastSequence);

    /// By ascending sequence, so oldest first.
    [[nodiscard]] const std::deque<OutboxEntry>& GetUnacknowledged() const noexcept;
    /// Number of entries that are ErrorReports.
    [[nodiscard]] std::size_t CountAlarms() const noexcept;
    /// Sequence of the latest report of this alarm; nullopt if it was acknowledged or none was made.
    [[nodiscard]] std::optional<std::uint64_t> FindAlarmOrNull(const Alarm& alarm) const;

private:
    [[nodiscard]] static AlarmKey MakeKey(const Alarm& alarm);
    void AddToIndex(const OutboxEntry& entry);
};

} // namespace ACS::Planning
