#pragma once

#include <acs/core/Result.hpp>

#include <SQLiteCpp/Database.h>

#include <string>

namespace ACS::Planning
{

/// "acsd.db.rescued": where what was stored is copied to when the store's file is gone while it is open, as the open file
/// goes with this program. The next start takes it up.
[[nodiscard]] std::string GetRescuePath(const std::string& storePath);

/// Copies all that the open database holds to its rescue path, on disk on return. EPlanningError::StoreFailed.
[[nodiscard]] Core::Result<void> RescueStore(SQLite::Database& database, const std::string& storePath);

/// The file is back: nobody needs the copy any more.
void ForgetRescued(const std::string& storePath);

/// Whether no copy waits, or it can be taken up: not where there is a store too, as only a person can tell which of the
/// two holds. EPlanningError::StoreFailed.
[[nodiscard]] Core::Result<void> CheckRescued(const std::string& storePath);

/// Before the store is opened: makes it of the copy where there is no store. Says whether it did. EPlanningError::StoreFailed.
[[nodiscard]] Core::Result<bool> TakeUpRescued(const std::string& storePath);

} // namespace ACS::Planning
