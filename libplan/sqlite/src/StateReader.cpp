#include "StateReader.hpp"

#include "StoreFault.hpp"
#include <acs/plan/EPlanningError.hpp>
#include <acs/plan/StoreCodec.hpp>

#include <fmt/format.h>
#include <SQLiteCpp/Statement.h>

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace ACS::Planning
{

namespace
{

Core::WallTime ToTime(std::int64_t count)
{
    return Core::WallTime(Core::WallTime::duration(count));
}

std::uint64_t ToSequence(const SQLite::Column& column)
{
    return static_cast<std::uint64_t>(column.getInt64());
}

tl::unexpected<Core::Error> RefuseRow(const std::string& path, const std::string& row, const std::string& reason)
{
    return Refuse(
        EPlanningError::StoreCorrupt,
        path,
        fmt::format("rows that can be read; {}", RESTORE_IT),
        fmt::format("{}: {}", row, reason));
}

bool IsFitting(const Plan& plan, const PlanProgress& progress)
{
    bool bFitting = !plan.steps.empty() && plan.steps.size() == progress.steps.size();
    for (std::size_t i = 0; bFitting && i < plan.steps.size(); ++i)
    {
        bFitting = plan.steps[i].jobs.size() == progress.steps[i].jobs.size();
    }
    return bFitting;
}

/// Decodes the rows of a query with one column.
template <typename TDecode, typename TValue>
Core::Result<void> ReadRows(
    SQLite::Database& database,
    const std::string& path,
    const char* text,
    TDecode decode,
    std::vector<TValue>& out)
{
    SQLite::Statement query(database, text);
    while (query.executeStep())
    {
        Core::Result<TValue> value = decode(query.getColumn(0).getString());
        if (!value.has_value())
        {
            return RefuseRow(path, text, Core::Describe(value.error()));
        }
        out.push_back(std::move(*value));
    }
    return {};
}

Core::Result<void> ReadPlans(SQLite::Database& database, const std::string& path, StoredState& state)
{
    SQLite::Statement query(
        database,
        "SELECT sequence, plan_id, accepted_at, plan, progress, transaction_id FROM plans ORDER BY sequence");
    while (query.executeStep())
    {
        const std::string row = "plan " + query.getColumn(1).getString();
        Core::Result<Plan> plan = DecodePlan(query.getColumn(3).getString());
        Core::Result<PlanProgress> progress = DecodeProgress(query.getColumn(4).getString());
        if (!plan.has_value() || !progress.has_value())
        {
            return RefuseRow(path, row, Core::Describe(plan.has_value() ? progress.error() : plan.error()));
        }
        if (!IsFitting(*plan, *progress))
        {
            return RefuseRow(path, row, "the number of states differs from the number of steps or jobs");
        }
        PlanRecord& record = state.plans.emplace_back();
        record.sequence = ToSequence(query.getColumn(0));
        record.acceptedAt = ToTime(query.getColumn(2).getInt64());
        record.plan = std::move(*plan);
        record.progress = std::move(*progress);
        record.transactionID = query.getColumn(5).getString();
    }
    return {};
}

Core::Result<void> ReadReports(SQLite::Database& database, const std::string& path, StoredState& state)
{
    SQLite::Statement query(database, "SELECT sequence, transaction_id, time, report FROM reports ORDER BY sequence");
    while (query.executeStep())
    {
        const std::uint64_t sequence = ToSequence(query.getColumn(0));
        Core::Result<Report> report = DecodeReport(query.getColumn(3).getString());
        if (!report.has_value())
        {
            return RefuseRow(path, fmt::format("report {}", sequence), Core::Describe(report.error()));
        }
        state.outbox.push_back(
            {sequence, query.getColumn(1).getString(), ToTime(query.getColumn(2).getInt64()), std::move(*report)});
    }
    // AUTOINCREMENT remembers the highest number, acknowledged reports included.
    SQLite::Statement last(database, "SELECT seq FROM sqlite_sequence WHERE name = 'reports'");
    if (last.executeStep())
    {
        state.lastReportSequence = ToSequence(last.getColumn(0));
    }
    return {};
}

void ReadReceipts(SQLite::Database& database, StoredState& state)
{
    SQLite::Statement query(database, "SELECT owner, key, answer, time FROM receipts ORDER BY sequence");
    while (query.executeStep())
    {
        state.receipts.push_back(
            {query.getColumn(0).getString(),
             query.getColumn(1).getString(),
             query.getColumn(2).getString(),
             ToTime(query.getColumn(3).getInt64())});
    }
}

void ReadHoldReason(SQLite::Database& database, StoredState& state)
{
    SQLite::Statement query(database, "SELECT value FROM settings WHERE name = 'hold_reason'");
    if (query.executeStep())
    {
        state.holdReason = query.getColumn(0).getString();
    }
}

Core::Result<void> ReadTscState(SQLite::Database& database, const std::string& path, StoredState& state)
{
    SQLite::Statement query(database, "SELECT value FROM settings WHERE name = 'tsc_state'");
    if (!query.executeStep())
    {
        return {};
    }
    const std::string text = query.getColumn(0).getString();
    for (const ETscState candidate : {ETscState::Auto, ETscState::Paused, ETscState::Pausing})
    {
        if (text == GetText(candidate))
        {
            state.tscState = candidate;
            return {};
        }
    }
    return RefuseRow(path, "state of the TSC", text);
}

} // namespace

Core::Result<StoredState> ReadState(SQLite::Database& database, const std::string& path)
{
    StoredState state;
    ReadHoldReason(database, state);
    ReadReceipts(database, state);
    SQLite::Statement maintenance(database, "SELECT robot_id FROM maintenance ORDER BY robot_id");
    while (maintenance.executeStep())
    {
        state.robotsInMaintenance.push_back(maintenance.getColumn(0).getString());
    }
    const auto readRows = [&database, &path](const char* text, auto decode, auto& out) {
        return ReadRows(database, path, text, decode, out);
    };
    return ReadPlans(database, path, state)
        .and_then([&] { return ReadReports(database, path, state); })
        .and_then([&] { return ReadTscState(database, path, state); })
        .and_then(
            [&] { return readRows("SELECT carriers FROM carriers ORDER BY robot_id", DecodeCarriers, state.carriers); })
        .and_then([&] { return readRows("SELECT alarm FROM alarms", DecodeAlarm, state.alarms); })
        .and_then([&] {
            return readRows("SELECT work FROM robot_works ORDER BY robot_id", DecodeRobotWork, state.robotWorks);
        })
        .and_then([&] { return readRows("SELECT block FROM blocks ORDER BY sequence", DecodeBlock, state.blocks); })
        .map([&state] { return std::move(state); });
}

} // namespace ACS::Planning
