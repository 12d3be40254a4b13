#include "ChangeWriter.hpp"

#include <acs/core/Overloaded.hpp>
#include <acs/plan/StoreCodec.hpp>

#include <cstdint>
#include <variant>

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

} // namespace

ChangeWriter::ChangeWriter(SQLite::Database& database)
    : _database(database)
{
}

void ChangeWriter::Write(const StoreChange& change)
{
    const Core::Overloaded writer{
        [this](const PlanAdded& added) {
            const PlanRecord& record = added.record;
            Run("INSERT INTO plans VALUES (?, ?, ?, ?, ?, ?, ?)",
                ToInteger(record.sequence),
                record.plan.planID,
                ToCount(record.acceptedAt),
                EncodePlan(record.plan),
                std::string(GetText(record.progress.state)),
                EncodeProgress(record.progress),
                record.transactionID);
        },
        [this](const PlanProgressed& progressed) {
            Run("UPDATE plans SET state = ?, progress = ? WHERE plan_id = ?",
                std::string(GetText(progressed.progress.state)),
                EncodeProgress(progressed.progress),
                progressed.planID);
        },
        [this](const PlanRemoved& removed) {
            Run("DELETE FROM plans WHERE sequence = ?", ToInteger(removed.sequence));
        },
        [this](const ReportAdded& added) {
            const OutboxEntry& entry = added.entry;
            Run("INSERT INTO reports VALUES (?, ?, ?, ?)",
                ToInteger(entry.sequence),
                entry.transactionID,
                ToCount(entry.time),
                EncodeReport(entry.report));
        },
        [this](const ReportRemoved& removed) {
            Run("DELETE FROM reports WHERE sequence = ?", ToInteger(removed.sequence));
        },
        [this](const CarriersChanged& changed) {
            Run("INSERT OR REPLACE INTO carriers VALUES (?, ?)", changed.robotID, EncodeCarriers(changed));
        },
        [this](const AlarmSet& set) {
            const Alarm& alarm = set.alarm;
            Run("INSERT OR REPLACE INTO alarms VALUES (?, ?, ?, ?, ?)",
                alarm.robotID,
                alarm.errorCode,
                alarm.planID.value_or(""),
                alarm.jobID.value_or(""),
                EncodeAlarm(alarm));
        },
        [this](const AlarmCleared& cleared) {
            const Alarm& alarm = cleared.alarm;
            Run("DELETE FROM alarms WHERE robot_id = ? AND error_code = ? AND plan_id = ? AND job_id = ?",
                alarm.robotID,
                alarm.errorCode,
                alarm.planID.value_or(""),
                alarm.jobID.value_or(""));
        },
        [this](const TscChanged& changed) {
            Run("INSERT OR REPLACE INTO settings VALUES ('tsc_state', ?)", std::string(GetText(changed.state)));
            if (changed.state == ETscState::Auto)
            {
                Run("DELETE FROM settings WHERE name = 'hold_reason'");
            }
        },
        [this](const RobotWorkChanged& changed) {
            Run("INSERT OR REPLACE INTO robot_works VALUES (?, ?)", changed.robotID, EncodeRobotWork(changed));
        },
        [this](const MaintenanceChanged& changed) {
            Run(changed.bOn ? "INSERT OR REPLACE INTO maintenance VALUES (?)"
                            : "DELETE FROM maintenance WHERE robot_id = ?",
                changed.robotID);
        },
        [this](const BlockAdded& added) {
            Run("INSERT INTO blocks (kind, id, block) VALUES (?, ?, ?)",
                std::string(GetText(added.block.kind)),
                added.block.id,
                EncodeBlock(added.block));
        },
        [this](const BlockRemoved& removed) {
            Run("DELETE FROM blocks WHERE kind = ? AND id = ?", std::string(GetText(removed.kind)), removed.id);
        },
        [this](const ReceiptAdded& added) {
            const CommandReceipt& receipt = added.receipt;
            Run("INSERT INTO receipts (owner, key, answer, time) VALUES (?, ?, ?, ?)",
                receipt.owner,
                receipt.key,
                receipt.answer,
                ToCount(receipt.time));
            Run("DELETE FROM receipts WHERE time <= ? OR sequence <= last_insert_rowid() - ?",
                ToCount(receipt.time - CommandReceipt::KEPT),
                static_cast<std::int64_t>(CommandReceipt::MOST_RECEIPTS));
        }};
    std::visit(writer, change);
}

/// Resets the statement before and after: it may have failed the last time, and it must not keep a lock.
template <typename... TValues>
void ChangeWriter::Run(const char* text, const TValues&... values)
{
    SQLite::Statement& statement = _statements.try_emplace(text, _database, text).first->second;
    statement.tryReset();
    int position = 0;
    (statement.bind(++position, values), ...);
    statement.exec();
    statement.reset();
}

} // namespace ACS::Planning
