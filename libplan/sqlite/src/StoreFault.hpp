#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan/EPlanningError.hpp>

#include <SQLiteCpp/Exception.h>

#include <string>
#include <string_view>

namespace ACS::Planning
{

/// The remedy if the plans in a database cannot be read.
inline constexpr std::string_view RESTORE_IT =
    "move it away with the files beside it (-wal, -shm, generation) to start with an empty store, or restore a backup with acsd "
    "store restore";

/// Makes an error of a store: its path, what is expected with the remedy ("expected …; …"), and what failed with the reason of
/// the system or of SQLite ("found …").
[[nodiscard]] tl::unexpected<Core::Error> Refuse(
    EPlanningError error,
    const std::string& path,
    std::string expected,
    std::string found);

/// EPlanningError::StoreFailed.
[[nodiscard]] tl::unexpected<Core::Error> Refuse(const std::string& path, std::string expected, std::string found);

/// Makes the error for an exception of SQLite during an operation ("writing"). systemError is an errno value, 0 if unknown.
[[nodiscard]] tl::unexpected<Core::Error> RefuseFor(
    const SQLite::Exception& exception,
    const std::string& path,
    std::string_view operation,
    int systemError);

[[nodiscard]] std::string DescribeErrno(int reason);

} // namespace ACS::Planning
