#include "store/StoreCommand.hpp"

#include "common/config/CommandLine.hpp"
#include "common/process/SystemClock.hpp"
#include "store/StoreSummary.hpp"
#include <acs/core/Timestamp.hpp>
#include <acs/plan/EPlanningError.hpp>
#include <acs/plan_postgres/PostgresPlanStore.hpp>
#include <acs/plan_sqlite/SqlitePlanStore.hpp>
#include <acs/plan_sqlite/StoreBackup.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <functional>
#include <optional>
#include <string>

namespace ACS::Acsd
{

namespace
{

constexpr const char* NAME = "acsd store";

/// The text to print.
using Outcome = Core::Result<std::string>;

bool IsShared(const std::string& place)
{
    return place.starts_with("postgres://") || place.starts_with("postgresql://");
}

template <typename TStore, typename TPlace>
Outcome CheckStore(const TPlace& place)
{
    return TStore::Inspect(place).and_then([&](const Planning::StoreOrigin& origin) {
        return TStore::InspectState(place).map(
            [&](const Planning::StoredState& state) { return MakeStoreSummary(origin, state); });
    });
}

/// A store in PostgreSQL has programs of its own for this.
tl::unexpected<Core::Error> RefuseShared(const std::string& command)
{
    return Core::Fail(
        make_error_code(Planning::EPlanningError::StoreFailed),
        command,
        "the directory of a store; for a store in PostgreSQL use pg_dump and pg_restore (docs/guide/run-a-standby.md)",
        "a URL");
}

Outcome Check(const std::string& place)
{
    return IsShared(place) ? CheckStore<Planning::PostgresPlanStore>(Planning::PostgresOptions{place, {}})
                           : CheckStore<Planning::SqlitePlanStore>(place);
}

Outcome Accept(const std::string& directory)
{
    const Core::Result<Planning::StoreOrigin> origin = Planning::SqlitePlanStore::Inspect(directory);
    if (origin.has_value() && !origin->bNew)
    {
        return "nothing to accept: this is the store that was used last";
    }
    const std::string reason = fmt::format(
        "The store was restored, copied or incomplete, and was accepted at {}. Its plans may be out of date: check the plans, the "
        "robots and their carriers, cancel what is done, then resume the TSC.",
        Core::FormatUTC(Apps::SystemClock().GetNow().wall));
    return Planning::SqlitePlanStore::Accept(directory, reason).map([](const auto& /*store*/) {
        return std::string("accepted: the next start has the TSC paused and moves no robot until it is resumed");
    });
}

Outcome BackUp(const std::string& directory, const std::string& file)
{
    return Planning::BackUpStore(directory, file).map([&file] { return fmt::format("copied to {}", file); });
}

Outcome Restore(const std::string& directory, const std::string& file)
{
    return Planning::RestoreStore(directory, file).map([&] {
        return fmt::format(
            "restored from {}; the previous database, if there was one, is acsd.db.previous. Run acsd store accept {} before the "
            "next start",
            file,
            directory);
    });
}

} // namespace

int RunStoreCommand(int argc, const char* const* argv)
{
    CLI::App app{"Checks, copies and replaces the store of acsd. Run it as the user of acsd.", NAME};
    app.require_subcommand(1);
    app.footer(
        "Exit codes: 0 when done; 1 if the store or the file does not allow it; 2 for an error in the command line.");
    std::string directory;
    std::string file;
    std::function<Outcome()> run;
    const auto add =
        [&](const std::string& name, const char* help, const char* fileHelpOrNull, std::function<Outcome()> work) {
            CLI::App& command = *app.add_subcommand(name, help);
            const bool bChecks = name == "check";
            command
                .add_option(
                    bChecks ? "STORE" : "DIR",
                    directory,
                    bChecks ? "directory of the store, or store.url" : "directory of the store")
                ->required();
            if (fileHelpOrNull != nullptr)
            {
                command.add_option("FILE", file, fileHelpOrNull)->required();
            }
            command.callback([&run, work = std::move(work)] { run = work; });
        };
    add("check",
        "report what the store has and whether acsd would start with it; changes nothing, also while acsd runs",
        nullptr,
        [&] { return Check(directory); });
    add("accept",
        "accept a store that was restored, copied or is incomplete; acsd then starts with the TSC paused",
        nullptr,
        [&] { return Accept(directory); });
    add("backup", "copy the database to a new file, also while acsd runs", "the new file", [&] {
        return BackUp(directory, file);
    });
    add("restore",
        "replace the database by a copy of a backup, while acsd is stopped; keeps the previous one",
        "the backup",
        [&] { return Restore(directory, file); });
    const std::optional<int> exitCodeOrNull = Apps::ParseCommandLineOrNull(app, argc, argv);
    if (exitCodeOrNull.has_value())
    {
        return *exitCodeOrNull;
    }
    const std::string command = app.get_subcommands().front()->get_name();
    const Outcome outcome = IsShared(directory) && command != "check" ? RefuseShared(command) : run();
    if (!outcome.has_value())
    {
        Apps::PrintError(NAME, Core::Describe(outcome.error()));
        return 1;
    }
    const Core::Result<Planning::PostgresTarget> target = Planning::ReadPostgresURL(directory);
    fmt::print("{}: {}\n", target.has_value() ? target->name : directory, *outcome);
    return 0;
}

} // namespace ACS::Acsd
