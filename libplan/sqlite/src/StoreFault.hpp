#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan/EPlanningError.hpp>

#include <SQLiteCpp/Exception.h>

#include <string>
#include <string_view>

namespace ACS::Planning
{

/// What to do with a file that holds no plans that can be read.
inline constexpr std::string_view RESTORE_IT =
    "move it away with the files -wal, -shm and .lock beside it, and put a backup there, or nothing to begin with an empty one";

/// Each error of a store names its path, what is wanted and what to do for it ("expected …; …"), and what failed with the
/// reason of the system or of SQLite ("found …").
[[nodiscard]] tl::unexpected<Core::Error> Refuse(
    EPlanningError error,
    const std::string& path,
    std::string expected,
    std::string found);

/// For an exception of SQLite. What was being done: "writing"; the system's error number, 0 where it is not known.
[[nodiscard]] tl::unexpected<Core::Error> RefuseFor(
    const SQLite::Exception& exception,
    const std::string& path,
    std::string_view doing,
    int systemError);

} // namespace ACS::Planning
