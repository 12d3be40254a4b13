#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/IPlanStore.hpp>
#include <acs/plan/ISqlDatabase.hpp>

#include <string>
#include <string_view>

namespace ACS::Planning
{

/// Writes a change into the tables of a plan store, within the transaction of the caller. The statements are those of SQLite
/// 3.24 and PostgreSQL 9.5 or later. Tables: plans, reports, carriers, alarms, settings, robot_works, maintenance, blocks and
/// receipts; blocks and receipts number their rows in a column `sequence`. Errors: those of the database.
[[nodiscard]] ACS_API Core::Result<void> WriteChange(ISqlDatabase& database, const StoreChange& change);

/// What differs between the databases when their content is read.
struct SqlStateOptions
{
    std::string name;            ///< Of the database, for errors: its path, or its URL without a password.
    std::string remedy;          ///< What an operator can do if a row cannot be read.
    std::string lastReportQuery; ///< Selects the highest sequence of a report ever stored; no row: none.
};

/// Reads what WriteChange wrote. Errors: EPlanningError::StoreCorrupt if a row cannot be read; those of the database.
[[nodiscard]] ACS_API Core::Result<StoredState> ReadStoredState(ISqlDatabase& database, const SqlStateOptions& options);

} // namespace ACS::Planning
