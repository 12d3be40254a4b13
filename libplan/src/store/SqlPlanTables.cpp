#include <acs/core/Overloaded.hpp>
#include <acs/core/ParseNumber.hpp>
#include <acs/plan/EPlanningError.hpp>
#include <acs/plan/SqlPlanTables.hpp>
#include <acs/plan/StoreCodec.hpp>
#include <acs/plan_json/PlanEnumNames.hpp>

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Planning
{

namespace
{

std::int64_t ToCount(Core::WallTime time)
{
    return time.time_since_epoch().count();
}

std::int64_t ToInteger(std::uint64_t sequence)
{
    return static_cast<std::int64_t>(sequence);
}

Core::Result<void> WriteReceipt(ISqlDatabase& database, const CommandReceipt& receipt)
{
    return database
        .Run(
            "INSERT INTO receipts (owner, key, answer, time) VALUES ($1, $2, $3, $4)",
            {receipt.owner, receipt.key, receipt.answer, ToCount(receipt.time)})
        .and_then([&] {
            return database.Run(
                "DELETE FROM receipts WHERE time <= $1 OR sequence <= (SELECT max(sequence) FROM receipts) - $2",
                {ToCount(receipt.time - CommandReceipt::KEPT),
                 static_cast<std::int64_t>(CommandReceipt::MOST_RECEIPTS)});
        });
}

Core::Result<void> WriteTSC(ISqlDatabase& database, ETscState state)
{
    Core::Result<void> written = database.Run(
        "INSERT INTO settings (name, value) VALUES ('tsc_state', $1) ON CONFLICT (name) DO UPDATE SET value = excluded.value",
        {std::string(GetText(state))});
    return written.has_value() && state == ETscState::Auto
        ? database.Run("DELETE FROM settings WHERE name = 'hold_reason'", {})
        : written;
}

/// Reads rows; the first one that cannot be read is the error.
class RowReader
{
    ISqlDatabase& _database;
    const SqlStateOptions& _options;

public:
    RowReader(ISqlDatabase& database, const SqlStateOptions& options)
        : _database(database),
          _options(options)
    {
    }

    [[nodiscard]] Core::Result<StoredState> Read()
    {
        StoredState state;
        return ReadPlans(state.plans)
            .and_then([&] { return ReadReports(state.outbox); })
            .and_then([&] { return ReadLastReport(state.lastReportSequence); })
            .and_then([&] {
                return ReadTexts("SELECT carriers FROM carriers ORDER BY robot_id", DecodeCarriers, state.carriers);
            })
            .and_then([&] {
                return ReadTexts(
                    "SELECT alarm FROM alarms ORDER BY robot_id, error_code, plan_id, job_id",
                    DecodeAlarm,
                    state.alarms);
            })
            .and_then([&] {
                return ReadTexts("SELECT work FROM robot_works ORDER BY robot_id", DecodeRobotWork, state.robotWorks);
            })
            .and_then(
                [&] { return ReadTexts("SELECT block FROM blocks ORDER BY sequence", DecodeBlock, state.blocks); })
            .and_then([&] { return ReadReceipts(state.receipts); })
            .and_then([&] { return ReadMaintenance(state.robotsInMaintenance); })
            .and_then([&] { return ReadSettings(state); })
            .map([&] { return std::move(state); });
    }

private:
    /// Calls the function with each row.
    template <typename TRead>
    [[nodiscard]] Core::Result<void> ForEachRow(std::string_view text, const TRead& read)
    {
        return _database.Query(text).and_then([&](const std::vector<SqlRow>& rows) {
            for (const SqlRow& row : rows)
            {
                if (Core::Result<void> result = read(row); !result.has_value())
                {
                    return result;
                }
            }
            return Core::Result<void>();
        });
    }

    [[nodiscard]] tl::unexpected<Core::Error> Refuse(std::string_view row, const std::string& reason) const
    {
        return Core::Fail(
            make_error_code(EPlanningError::StoreCorrupt),
            _options.name,
            fmt::format("rows that can be read; {}", _options.remedy),
            fmt::format("{}: {}", row, reason));
    }

    [[nodiscard]] Core::Result<std::int64_t> ReadNumber(std::string_view row, const std::string& text) const
    {
        const std::optional<std::int64_t> number = Core::ParseNumberOrNull<std::int64_t>(text);
        if (!number.has_value())
        {
            return Refuse(row, fmt::format("'{}' is no number", text));
        }
        return *number;
    }

    [[nodiscard]] Core::Result<std::uint64_t> ReadSequence(std::string_view row, const std::string& text) const
    {
        return ReadNumber(row, text).map([](std::int64_t number) { return static_cast<std::uint64_t>(number); });
    }

    [[nodiscard]] Core::Result<Core::WallTime> ReadTime(std::string_view row, const std::string& text) const
    {
        return ReadNumber(row, text).map(
            [](std::int64_t count) { return Core::WallTime(Core::WallTime::duration(count)); });
    }

    template <typename TDecode, typename TValue>
    [[nodiscard]] Core::Result<void> ReadTexts(std::string_view text, TDecode decode, std::vector<TValue>& out)
    {
        return ForEachRow(text, [&](const SqlRow& row) -> Core::Result<void> {
            Core::Result<TValue> value = decode(row[0]);
            if (!value.has_value())
            {
                return Refuse(text, Core::Describe(value.error()));
            }
            out.push_back(std::move(*value));
            return {};
        });
    }

    [[nodiscard]] Core::Result<void> ReadPlans(std::vector<PlanRecord>& out)
    {
        return ForEachRow(
            "SELECT sequence, plan_id, accepted_at, plan, progress, transaction_id FROM plans ORDER BY sequence",
            [&](const SqlRow& row) {
                return ReadPlan(row).map([&](PlanRecord record) { out.push_back(std::move(record)); });
            });
    }

    [[nodiscard]] Core::Result<PlanRecord> ReadPlan(const SqlRow& row) const
    {
        const std::string name = "plan " + row[1];
        const Core::Result<std::uint64_t> sequence = ReadSequence(name, row[0]);
        const Core::Result<Core::WallTime> time = ReadTime(name, row[2]);
        Core::Result<Plan> plan = DecodePlan(row[3]);
        Core::Result<PlanProgress> progress = DecodeProgress(row[4]);
        if (!sequence.has_value() || !time.has_value())
        {
            return tl::unexpected(sequence.has_value() ? time.error() : sequence.error());
        }
        if (!plan.has_value() || !progress.has_value())
        {
            return Refuse(name, Core::Describe(plan.has_value() ? progress.error() : plan.error()));
        }
        if (!IsFitting(*plan, *progress))
        {
            return Refuse(name, "the number of states differs from the number of steps or jobs");
        }
        PlanRecord record;
        record.sequence = *sequence;
        record.acceptedAt = *time;
        record.plan = std::move(*plan);
        record.progress = std::move(*progress);
        record.transactionID = row[5];
        return record;
    }

    [[nodiscard]] static bool IsFitting(const Plan& plan, const PlanProgress& progress)
    {
        bool bFitting = !plan.steps.empty() && plan.steps.size() == progress.steps.size();
        for (std::size_t i = 0; bFitting && i < plan.steps.size(); ++i)
        {
            bFitting = plan.steps[i].jobs.size() == progress.steps[i].jobs.size();
        }
        return bFitting;
    }

    [[nodiscard]] Core::Result<void> ReadReports(std::vector<OutboxEntry>& out)
    {
        return ForEachRow(
            "SELECT sequence, transaction_id, time, report FROM reports ORDER BY sequence",
            [&](const SqlRow& row) -> Core::Result<void> {
                const std::string name = "report " + row[0];
                const Core::Result<std::uint64_t> sequence = ReadSequence(name, row[0]);
                const Core::Result<Core::WallTime> time = ReadTime(name, row[2]);
                Core::Result<Report> report = DecodeReport(row[3]);
                if (!sequence.has_value() || !time.has_value())
                {
                    return tl::unexpected(sequence.has_value() ? time.error() : sequence.error());
                }
                if (!report.has_value())
                {
                    return Refuse(name, Core::Describe(report.error()));
                }
                out.push_back({*sequence, row[1], *time, std::move(*report)});
                return {};
            });
    }

    [[nodiscard]] Core::Result<void> ReadLastReport(std::uint64_t& out)
    {
        return ForEachRow(_options.lastReportQuery, [&](const SqlRow& row) {
            return ReadSequence("number of the last report", row[0]).map([&](std::uint64_t number) { out = number; });
        });
    }

    [[nodiscard]] Core::Result<void> ReadReceipts(std::vector<CommandReceipt>& out)
    {
        return ForEachRow("SELECT owner, key, answer, time FROM receipts ORDER BY sequence", [&](const SqlRow& row) {
            return ReadTime("receipt " + row[1], row[3]).map([&](Core::WallTime time) {
                out.push_back({row[0], row[1], row[2], time});
            });
        });
    }

    [[nodiscard]] Core::Result<void> ReadMaintenance(std::vector<std::string>& out)
    {
        return ForEachRow("SELECT robot_id FROM maintenance ORDER BY robot_id", [&](const SqlRow& row) {
            out.push_back(row[0]);
            return Core::Result<void>();
        });
    }

    [[nodiscard]] Core::Result<void> ReadSettings(StoredState& out)
    {
        return ForEachRow("SELECT name, value FROM settings", [&](const SqlRow& row) -> Core::Result<void> {
            if (row[0] == "hold_reason")
            {
                out.holdReason = row[1];
            }
            if (row[0] != "tsc_state")
            {
                return {};
            }
            const std::optional<ETscState> stateOrNull = FindTscStateOrNull(row[1]);
            if (!stateOrNull.has_value())
            {
                return Refuse("state of the TSC", row[1]);
            }
            out.tscState = *stateOrNull;
            return {};
        });
    }

    [[nodiscard]] static std::optional<ETscState> FindTscStateOrNull(std::string_view text)
    {
        ETscState state{};
        bool bExact = false;
        return Json::TryReadWord(text, state, bExact) && bExact ? std::optional(state) : std::nullopt;
    }
};

} // namespace

Core::Result<void> WriteChange(ISqlDatabase& database, const StoreChange& change)
{
    const Core::Overloaded writer{
        [&](const PlanAdded& added) {
            const PlanRecord& record = added.record;
            return database.Run(
                "INSERT INTO plans (sequence, plan_id, accepted_at, plan, state, progress, transaction_id) "
                "VALUES ($1, $2, $3, $4, $5, $6, $7)",
                {ToInteger(record.sequence),
                 record.plan.planID,
                 ToCount(record.acceptedAt),
                 EncodePlan(record.plan),
                 std::string(GetText(record.progress.state)),
                 EncodeProgress(record.progress),
                 record.transactionID});
        },
        [&](const PlanProgressed& progressed) {
            return database.Run(
                "UPDATE plans SET state = $1, progress = $2 WHERE plan_id = $3",
                {std::string(GetText(progressed.progress.state)),
                 EncodeProgress(progressed.progress),
                 progressed.planID});
        },
        [&](const PlanRemoved& removed) {
            return database.Run("DELETE FROM plans WHERE sequence = $1", {ToInteger(removed.sequence)});
        },
        [&](const ReportAdded& added) {
            const OutboxEntry& entry = added.entry;
            return database.Run(
                "INSERT INTO reports (sequence, transaction_id, time, report) VALUES ($1, $2, $3, $4)",
                {ToInteger(entry.sequence), entry.transactionID, ToCount(entry.time), EncodeReport(entry.report)});
        },
        [&](const ReportRemoved& removed) {
            return database.Run("DELETE FROM reports WHERE sequence = $1", {ToInteger(removed.sequence)});
        },
        [&](const CarriersChanged& changed) {
            return database.Run(
                "INSERT INTO carriers (robot_id, carriers) VALUES ($1, $2) "
                "ON CONFLICT (robot_id) DO UPDATE SET carriers = excluded.carriers",
                {changed.robotID, EncodeCarriers(changed)});
        },
        [&](const AlarmSet& set) {
            const Alarm& alarm = set.alarm;
            return database.Run(
                "INSERT INTO alarms (robot_id, error_code, plan_id, job_id, alarm) VALUES ($1, $2, $3, $4, $5) "
                "ON CONFLICT (robot_id, error_code, plan_id, job_id) DO UPDATE SET alarm = excluded.alarm",
                {alarm.robotID,
                 alarm.errorCode,
                 alarm.planID.value_or(""),
                 alarm.jobID.value_or(""),
                 EncodeAlarm(alarm)});
        },
        [&](const AlarmCleared& cleared) {
            const Alarm& alarm = cleared.alarm;
            return database.Run(
                "DELETE FROM alarms WHERE robot_id = $1 AND error_code = $2 AND plan_id = $3 AND job_id = $4",
                {alarm.robotID, alarm.errorCode, alarm.planID.value_or(""), alarm.jobID.value_or("")});
        },
        [&](const TscChanged& changed) { return WriteTSC(database, changed.state); },
        [&](const RobotWorkChanged& changed) {
            return database.Run(
                "INSERT INTO robot_works (robot_id, work) VALUES ($1, $2) "
                "ON CONFLICT (robot_id) DO UPDATE SET work = excluded.work",
                {changed.robotID, EncodeRobotWork(changed)});
        },
        [&](const MaintenanceChanged& changed) {
            return database.Run(
                changed.bOn ? "INSERT INTO maintenance (robot_id) VALUES ($1) ON CONFLICT (robot_id) DO NOTHING"
                            : "DELETE FROM maintenance WHERE robot_id = $1",
                {changed.robotID});
        },
        [&](const BlockAdded& added) {
            return database.Run(
                "INSERT INTO blocks (kind, id, block) VALUES ($1, $2, $3)",
                {std::string(GetText(added.block.kind)), added.block.id, EncodeBlock(added.block)});
        },
        [&](const BlockRemoved& removed) {
            return database.Run(
                "DELETE FROM blocks WHERE kind = $1 AND id = $2",
                {std::string(GetText(removed.kind)), removed.id});
        },
        [&](const ReceiptAdded& added) {
            return WriteReceipt(database, added.receipt);
        }};
    return std::visit(writer, change);
}

Core::Result<StoredState> ReadStoredState(ISqlDatabase& database, const SqlStateOptions& options)
{
    return RowReader(database, options).Read();
}

} // namespace ACS::Planning
