#include "SchemaMigrations.hpp"
#include "StoreFault.hpp"
#include "StoreFiles.hpp"
#include "StoreLock.hpp"
#include "StoreLog.hpp"
#include "StoreRescue.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/plan/EPlanningError.hpp>
#include <acs/plan/StoreCodec.hpp>
#include <acs/plan_sqlite/SqlitePlanStore.hpp>

#include <fmt/format.h>
#include <sqlite3.h>
#include <SQLiteCpp/SQLiteCpp.h>

#include <cerrno>
#include <filesystem>
#include <optional>
#include <system_error>
#include <type_traits>
#include <utility>

namespace ACS::Planning
{

namespace
{

constexpr int BUSY_MILLISECONDS = 1'000;

/// Names in the table settings.
constexpr std::string_view TSC_STATE = "tsc_state";

/// The schema that has that table first.
constexpr int SETTINGS_VERSION = 2;

std::int64_t ToCount(Core::WallTime time)
{
    return time.time_since_epoch().count();
}

Core::WallTime ToTime(std::int64_t count)
{
    return Core::WallTime(Core::WallTime::duration(count));
}

int GetPragma(SQLite::Database& database, const char* pragma)
{
    return database.execAndGet(std::string("PRAGMA ") + pragma).getInt();
}

} // namespace

class SqlitePlanStore::Impl
{
    std::string _path;
    bool _bFoundWithoutLog;         ///< There was a file that was not empty, and no log.
    std::optional<StoreMark> _mark; ///< As it was found.
    StoreLock _lock;                ///< Outlives the database.
    SQLite::Database _database;
    std::unique_ptr<StoreLog> _log; ///< Once it is ours.
    StoreFiles _files;
    StoreOrigin _origin;
    int _systemError = 0;
    bool _bRescued = false; ///< The files are gone, and what they held is copied.
    // Prepared once; made after the migration, hence by pointer.
    std::unique_ptr<SQLite::Statement> _addPlan;
    std::unique_ptr<SQLite::Statement> _progressPlan;
    std::unique_ptr<SQLite::Statement> _removePlan;
    std::unique_ptr<SQLite::Statement> _addReport;
    std::unique_ptr<SQLite::Statement> _removeReport;
    std::unique_ptr<SQLite::Statement> _setCarriers;
    std::unique_ptr<SQLite::Statement> _setRobotWork;
    std::unique_ptr<SQLite::Statement> _setAlarm;
    std::unique_ptr<SQLite::Statement> _clearAlarm;
    std::unique_ptr<SQLite::Statement> _setSetting;
    std::unique_ptr<SQLite::Statement> _beginMaintenance;
    std::unique_ptr<SQLite::Statement> _endMaintenance;

public:
    /// Throws SQLite::Exception, as all of this class.
    Impl(const std::string& path, const std::string& file, int flags)
        : _path(path),
          _bFoundWithoutLog(StoreFiles::HasOnlyStore(path)),
          _mark(StoreLock::ReadMarkOrNull(path)),
          _database(file, flags, BUSY_MILLISECONDS)
    {
        // Until it is ours: to close a store brings its log into it.
        StoreLog::Keep(_database, !_bFoundWithoutLog);
    }

    [[nodiscard]] const std::string& GetPath() const noexcept
    {
        return _path;
    }

    [[nodiscard]] StoreOrigin& GetOrigin() noexcept
    {
        return _origin;
    }

    /// The system's number of the write that failed last.
    [[nodiscard]] int GetSystemError() const noexcept
    {
        return _systemError;
    }

    [[nodiscard]] Core::Result<void> Lock()
    {
        Core::Result<StoreLock> lock = StoreLock::Acquire(_path);
        if (!lock.has_value())
        {
            return tl::unexpected(std::move(lock.error()));
        }
        _lock = std::move(*lock);
        return {};
    }

    /// Before anything is written: is this a file of ours, undamaged, and not from the future?
    [[nodiscard]] Core::Result<void> Check()
    {
        const int version = GetPragma(_database, "user_version");
        const int applicationID = GetPragma(_database, "application_id");
        const int tables = _database.execAndGet("SELECT count(*) FROM sqlite_master").getInt();
        const bool bEmpty = version == 0 && applicationID == 0 && tables == 0;
        if (!bEmpty && applicationID != STORE_APPLICATION_ID)
        {
            return Refuse(
                EPlanningError::StoreCorrupt,
                _path,
                "a plan store; give another path",
                "a database of another program");
        }
        if (bEmpty && _bFoundWithoutLog)
        {
            return Refuse(
                EPlanningError::StoreCorrupt,
                _path,
                fmt::format("a plan store, or no file; {}", RESTORE_IT),
                "a database without any table, and no log beside it");
        }
        if (!bEmpty && version <= 0)
        {
            return Refuse(
                EPlanningError::StoreCorrupt,
                _path,
                fmt::format("an undamaged plan store; {}", RESTORE_IT),
                fmt::format("the schema version {}", version));
        }
        if (version > GetNewestSchemaVersion())
        {
            return Refuse(
                EPlanningError::StoreTooNew,
                _path,
                fmt::format(
                    "a schema up to version {}; start the newer program that wrote it, or restore what was saved before it",
                    GetNewestSchemaVersion()),
                fmt::format("version {}", version));
        }
        if (Core::Result<void> logged = CheckLog(bEmpty, version); !logged.has_value())
        {
            return logged;
        }
        const std::string verdict = _database.execAndGet("PRAGMA quick_check(1)").getString();
        if (verdict != "ok")
        {
            return Refuse(
                EPlanningError::StoreCorrupt,
                _path,
                fmt::format("an undamaged plan store; {}", RESTORE_IT),
                verdict);
        }
        _origin.bNew = bEmpty;
        _origin.foundVersion = version;
        _origin.version = GetNewestSchemaVersion();
        return {};
    }

    void Prepare()
    {
        _database.exec("PRAGMA synchronous = FULL");
        _database.exec("PRAGMA foreign_keys = ON");
        const int found = GetPragma(_database, "user_version");
        if (_origin.bNew)
        {
            _lock.Unmark(); // of one that was moved away
        }
        // A new one gets its schema before its log: where it cannot be written, nothing is left of it.
        MigrateSchema(_database, found);
        _database.exec("PRAGMA journal_mode = WAL");
        _addPlan = MakeStatement("INSERT INTO plans VALUES (?, ?, ?, ?, ?, ?, ?)");
        _progressPlan = MakeStatement("UPDATE plans SET state = ?, progress = ? WHERE plan_id = ?");
        _removePlan = MakeStatement("DELETE FROM plans WHERE sequence = ?");
        _addReport = MakeStatement("INSERT INTO reports VALUES (?, ?, ?, ?)");
        _removeReport = MakeStatement("DELETE FROM reports WHERE sequence = ?");
        _setCarriers = MakeStatement("INSERT OR REPLACE INTO carriers VALUES (?, ?)");
        _setRobotWork = MakeStatement("INSERT OR REPLACE INTO robot_works VALUES (?, ?)");
        _setAlarm = MakeStatement("INSERT OR REPLACE INTO alarms VALUES (?, ?, ?, ?, ?)");
        _clearAlarm =
            MakeStatement("DELETE FROM alarms WHERE robot_id = ? AND error_code = ? AND plan_id = ? AND job_id = ?");
        _beginMaintenance = MakeStatement("INSERT OR REPLACE INTO maintenance VALUES (?)");
        _endMaintenance = MakeStatement("DELETE FROM maintenance WHERE robot_id = ?");
        _setSetting = MakeStatement("INSERT OR REPLACE INTO settings VALUES (?, ?)");
        // All tables are there: from now on it is not refused any more.
        _log = std::make_unique<StoreLog>(_database, _lock);
        if (!_origin.bNew && found != GetNewestSchemaVersion())
        {
            static_cast<void>(_log->TryFold()); // a copy of the file alone has the schema too
        }
        _files = StoreFiles(_path, std::string(sqlite3_db_filename(_database.getHandle(), "main")) + "-wal");
    }

    /// SQLite would go on writing to a file that has no name any more, and so is lost at the end.
    [[nodiscard]] Core::Result<void> CheckFiles()
    {
        std::optional<StoreFileChange> change = _files.FindChangeOrNull();
        if (!change.has_value())
        {
            if (std::exchange(_bRescued, false))
            {
                ForgetRescued(_path);
            }
            return {};
        }
        return Refuse(EPlanningError::StoreFailed, _path, Rescue(*change), std::move(change->found));
    }

    [[nodiscard]] Core::Result<void> Append(const StoreBatch& batch)
    {
        Core::Result<void> begun = NoteErrors([this] { return _log->Begin(); });
        if (!begun.has_value())
        {
            return begun;
        }
        SQLite::Transaction transaction(_database);
        NoteErrors([this, &batch, &transaction] {
            for (const StoreChange& change : batch.changes)
            {
                std::visit([this](const auto& typed) { Write(typed); }, change);
            }
            transaction.commit();
        });
        _log->FoldIfLong();
        return {};
    }

    [[nodiscard]] Core::Result<StoredState> Load()
    {
        StoredState state;
        Core::Result<void> read = ReadPlans(state);
        if (read.has_value())
        {
            read = ReadReports(state);
        }
        if (read.has_value())
        {
            read = ReadRows("SELECT carriers FROM carriers ORDER BY robot_id", DecodeCarriers, state.carriers);
        }
        if (read.has_value())
        {
            read = ReadRows("SELECT alarm FROM alarms", DecodeAlarm, state.alarms);
        }
        if (read.has_value())
        {
            read = ReadRows("SELECT work FROM robot_works ORDER BY robot_id", DecodeRobotWork, state.robotWorks);
        }
        if (read.has_value())
        {
            ReadMaintenance(state);
            read = ReadTscState(state);
        }
        if (!read.has_value())
        {
            return tl::unexpected(std::move(read.error()));
        }
        return state;
    }

private:
    /// What was stored last may have been in a log that is not there any more.
    [[nodiscard]] Core::Result<void> CheckLog(bool bEmpty, int version)
    {
        if (bEmpty || !_mark.has_value())
        {
            return {};
        }
        const std::int64_t number = version < SETTINGS_VERSION ? 0 : StoreLog::GetNumber(_database);
        if (_mark->bNeedsLog ? !_bFoundWithoutLog : number >= _mark->number)
        {
            return {};
        }
        return Refuse(
            EPlanningError::StoreCorrupt,
            _path,
            fmt::format(
                "what was stored last, which was in {}, as the program before did not close the store; put that file back; or, "
                "to go on with what the store itself has, such as a backup that was restored, remove {}",
                StoreFiles::GetLogPath(_path),
                StoreLock::GetPath(_path)),
            _mark->bNeedsLog ? "no such file" : fmt::format("logs up to number {} of {}", number, _mark->number));
    }

    /// What the system says of a failure is there before the roll-back; SQLite's own note of it lacks those of a commit.
    template <typename TWork>
    std::invoke_result_t<TWork> NoteErrors(TWork work)
    {
        errno = 0;
        try
        {
            return work();
        }
        catch (const SQLite::Exception&)
        {
            _systemError = errno;
            throw;
        }
    }

    /// Saves what is stored, and says what is to be done.
    [[nodiscard]] std::string Rescue(const StoreFileChange& change)
    {
        if (change.bOfLog)
        {
            return _log->TryFold()
                ? "the log that it has opened; restart: what was stored is in the store itself, and nothing else "
                  "is from now on"
                : "the log that it has opened; close each other program that reads the store: what was stored "
                  "last is not in the store itself as long as one does";
        }
        const Core::Result<void> rescued = _bRescued ? Core::Result<void>() : RescueStore(_database, _path);
        _bRescued = rescued.has_value();
        if (!_bRescued)
        {
            return fmt::format(
                "the file that it has opened; put it back before this program ends, or all is lost with it, as no copy can be "
                "made: {}",
                Core::Describe(rescued.error()));
        }
        return fmt::format(
            "the file that it has opened; put it back, or {}restart: what was stored is in {}, and the next start takes it up",
            change.bReplaced ? "move the other one away and " : "",
            GetRescuePath(_path));
    }

    [[nodiscard]] std::unique_ptr<SQLite::Statement> MakeStatement(const char* text)
    {
        return std::make_unique<SQLite::Statement>(_database, text);
    }

    /// Runs a prepared statement with these values and leaves it ready for the next time, also after a failure.
    template <typename... TValues>
    static void Run(SQLite::Statement& statement, const TValues&... values)
    {
        statement.tryReset();
        int position = 0;
        (statement.bind(++position, values), ...);
        statement.exec();
        statement.reset();
    }

    void Write(const PlanAdded& change)
    {
        const PlanRecord& record = change.record;
        Run(*_addPlan,
            static_cast<std::int64_t>(record.sequence),
            record.plan.planID,
            ToCount(record.acceptedAt),
            EncodePlan(record.plan),
            std::string(GetText(record.progress.state)),
            EncodeProgress(record.progress),
            record.transactionID);
    }

    void Write(const PlanProgressed& change)
    {
        Run(*_progressPlan,
            std::string(GetText(change.progress.state)),
            EncodeProgress(change.progress),
            change.planID);
    }

    void Write(const PlanRemoved& change)
    {
        Run(*_removePlan, static_cast<std::int64_t>(change.sequence));
    }

    void Write(const TscChanged& change)
    {
        Run(*_setSetting, std::string(TSC_STATE), std::string(GetText(change.state)));
    }

    void Write(const MaintenanceChanged& change)
    {
        Run(change.bOn ? *_beginMaintenance : *_endMaintenance, change.robotID);
    }

    void Write(const ReportAdded& change)
    {
        Run(*_addReport,
            static_cast<std::int64_t>(change.entry.sequence),
            change.entry.transactionID,
            ToCount(change.entry.time),
            EncodeReport(change.entry.report));
    }

    void Write(const ReportRemoved& change)
    {
        Run(*_removeReport, static_cast<std::int64_t>(change.sequence));
    }

    void Write(const CarriersChanged& change)
    {
        Run(*_setCarriers, change.robotID, EncodeCarriers(change));
    }

    void Write(const RobotWorkChanged& change)
    {
        Run(*_setRobotWork, change.robotID, EncodeRobotWork(change));
    }

    void Write(const AlarmSet& change)
    {
        const Alarm& alarm = change.alarm;
        Run(*_setAlarm,
            alarm.robotID,
            alarm.errorCode,
            alarm.planID.value_or(""),
            alarm.jobID.value_or(""),
            EncodeAlarm(alarm));
    }

    void Write(const AlarmCleared& change)
    {
        const Alarm& alarm = change.alarm;
        Run(*_clearAlarm, alarm.robotID, alarm.errorCode, alarm.planID.value_or(""), alarm.jobID.value_or(""));
    }

    [[nodiscard]] tl::unexpected<Core::Error> RefuseRow(const std::string& row, const Core::Error& error) const
    {
        return Refuse(
            EPlanningError::StoreCorrupt,
            _path,
            fmt::format("rows that can be read; {}", RESTORE_IT),
            fmt::format("{}: {}", row, Core::Describe(error)));
    }

    [[nodiscard]] Core::Result<void> ReadPlans(StoredState& state)
    {
        SQLite::Statement query(
            _database,
            "SELECT sequence, plan_id, accepted_at, plan, progress, transaction_id FROM plans ORDER BY sequence");
        while (query.executeStep())
        {
            const std::string row = "plan " + query.getColumn(1).getString();
            Core::Result<Plan> plan = DecodePlan(query.getColumn(3).getString());
            Core::Result<PlanProgress> progress = DecodeProgress(query.getColumn(4).getString());
            if (!plan.has_value() || !progress.has_value())
            {
                return RefuseRow(row, plan.has_value() ? progress.error() : plan.error());
            }
            if (!IsFitting(*plan, *progress))
            {
                return Refuse(
                    EPlanningError::StoreCorrupt,
                    _path,
                    fmt::format("a state for each step and job; {}", RESTORE_IT),
                    row);
            }
            PlanRecord record;
            record.sequence = static_cast<std::uint64_t>(query.getColumn(0).getInt64());
            record.acceptedAt = ToTime(query.getColumn(2).getInt64());
            record.plan = std::move(*plan);
            record.progress = std::move(*progress);
            record.transactionID = query.getColumn(5).getString();
            state.plans.push_back(std::move(record));
        }
        return {};
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

    void ReadMaintenance(StoredState& state)
    {
        SQLite::Statement query(_database, "SELECT robot_id FROM maintenance ORDER BY robot_id");
        while (query.executeStep())
        {
            state.robotsInMaintenance.push_back(query.getColumn(0).getString());
        }
    }

    [[nodiscard]] Core::Result<void> ReadReports(StoredState& state)
    {
        SQLite::Statement query(
            _database,
            "SELECT sequence, transaction_id, time, report FROM reports ORDER BY sequence");
        while (query.executeStep())
        {
            Core::Result<Report> report = DecodeReport(query.getColumn(3).getString());
            if (!report.has_value())
            {
                return RefuseRow(fmt::format("report {}", query.getColumn(0).getInt64()), report.error());
            }
            state.outbox.push_back(
                {static_cast<std::uint64_t>(query.getColumn(0).getInt64()),
                 query.getColumn(1).getString(),
                 ToTime(query.getColumn(2).getInt64()),
                 std::move(*report)});
        }
        // AUTOINCREMENT remembers the highest number, acknowledged reports included.
        SQLite::Statement last(_database, "SELECT seq FROM sqlite_sequence WHERE name = 'reports'");
        if (last.executeStep())
        {
            state.lastReportSequence = static_cast<std::uint64_t>(last.getColumn(0).getInt64());
        }
        return {};
    }

    [[nodiscard]] Core::Result<void> ReadTscState(StoredState& state)
    {
        SQLite::Statement query(_database, "SELECT value FROM settings WHERE name = ?");
        query.bind(1, std::string(TSC_STATE));
        if (!query.executeStep())
        {
            return {};
        }
        const std::string word = query.getColumn(0).getString();
        for (const ETscState candidate : {ETscState::Auto, ETscState::Paused, ETscState::Pausing})
        {
            if (word == GetText(candidate))
            {
                state.tscState = candidate;
                return {};
            }
        }
        return Refuse(EPlanningError::StoreCorrupt, _path, fmt::format("a state of the TSC; {}", RESTORE_IT), word);
    }

    template <typename TDecode, typename TValue>
    [[nodiscard]] Core::Result<void> ReadRows(const char* text, TDecode decode, std::vector<TValue>& out)
    {
        SQLite::Statement query(_database, text);
        while (query.executeStep())
        {
            Core::Result<TValue> value = decode(query.getColumn(0).getString());
            if (!value.has_value())
            {
                return RefuseRow(text, value.error());
            }
            out.push_back(std::move(*value));
        }
        return {};
    }
};

SqlitePlanStore::SqlitePlanStore(std::unique_ptr<Impl> impl)
    : _impl(std::move(impl))
{
}

SqlitePlanStore::~SqlitePlanStore() = default;

Core::Result<std::unique_ptr<SqlitePlanStore>> SqlitePlanStore::Open(const std::string& path)
{
    Core::Result<void> usable = StoreFiles::CheckUsable(path);
    const Core::Result<bool> rescued = usable.has_value() ? TakeUpRescued(path) : tl::unexpected(usable.error());
    if (!rescued.has_value())
    {
        return tl::unexpected(rescued.error());
    }
    if (Core::Result<void> logged = StoreFiles::CheckLogHasStore(path); !logged.has_value())
    {
        return tl::unexpected(std::move(logged.error()));
    }
    try
    {
        auto impl = std::make_unique<Impl>(path, path, SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
        if (Core::Result<void> checked = impl->Check(); !checked.has_value())
        {
            return tl::unexpected(std::move(checked.error()));
        }
        if (Core::Result<void> locked = impl->Lock(); !locked.has_value())
        {
            return tl::unexpected(std::move(locked.error()));
        }
        impl->Prepare();
        impl->GetOrigin().bRescued = *rescued;
        return std::unique_ptr<SqlitePlanStore>(new SqlitePlanStore(std::move(impl)));
    }
    catch (const SQLite::Exception& exception)
    {
        return RefuseFor(exception, path, "opening", 0);
    }
}

Core::Result<StoreOrigin> SqlitePlanStore::Inspect(const std::string& path)
{
    if (Core::Result<void> usable = StoreFiles::CheckUsable(path); !usable.has_value())
    {
        return tl::unexpected(std::move(usable.error()));
    }
    if (Core::Result<void> checked = CheckRescued(path); !checked.has_value())
    {
        return tl::unexpected(std::move(checked.error()));
    }
    std::error_code missing;
    const bool bRescued = std::filesystem::exists(GetRescuePath(path), missing);
    if (Core::Result<void> logged = StoreFiles::CheckLogHasStore(path); !logged.has_value() && !bRescued)
    {
        return tl::unexpected(std::move(logged.error()));
    }
    if (!std::filesystem::exists(path, missing))
    {
        return StoreOrigin{!bRescued, bRescued, 0, GetNewestSchemaVersion()};
    }
    try
    {
        const std::optional<std::string> uri = StoreFiles::MakeUntouchedUriOrNull(path);
        Impl impl(path, uri.value_or(path), SQLite::OPEN_READONLY | (uri.has_value() ? SQLite::OPEN_URI : 0));
        if (Core::Result<void> checked = impl.Check(); !checked.has_value())
        {
            return tl::unexpected(std::move(checked.error()));
        }
        return impl.GetOrigin();
    }
    catch (const SQLite::Exception& exception)
    {
        return RefuseFor(exception, path, "opening", 0);
    }
}

const StoreOrigin& SqlitePlanStore::GetOrigin() const noexcept
{
    return _impl->GetOrigin();
}

Core::Result<StoredState> SqlitePlanStore::Load()
{
    try
    {
        return _impl->Load();
    }
    catch (const SQLite::Exception& exception)
    {
        return RefuseFor(exception, _impl->GetPath(), "reading", 0);
    }
}

Core::Result<void> SqlitePlanStore::Append(const StoreBatch& batch)
{
    if (Core::Result<void> same = Check(); !same.has_value())
    {
        return same;
    }
    try
    {
        return _impl->Append(batch);
    }
    catch (const SQLite::Exception& exception)
    {
        return RefuseFor(exception, _impl->GetPath(), "writing", _impl->GetSystemError());
    }
}

Core::Result<void> SqlitePlanStore::Check()
{
    try
    {
        return _impl->CheckFiles();
    }
    catch (const SQLite::Exception& exception)
    {
        return RefuseFor(exception, _impl->GetPath(), "saving what was in a lost log", 0);
    }
}

} // namespace ACS::Planning
