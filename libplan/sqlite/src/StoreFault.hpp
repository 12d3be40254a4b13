#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan/EPlanningError.hpp>

#include <SQLiteCpp/Exception.h>

#include <string>
#include <string_view>

namespace ACS::Planning
{

/// The remedy for a database whose plans cannot be read.
inline constexpr std::string_view RESTORE_IT =
    "move it away with the files beside it (-wal, -shm, generation), and put a backup there, or nothing to start with an empty "
    "store";

/// An error of a store names its path, what is expected and the remedy ("expected …; …"), and what failed with the reason of
/// the system or of SQLite ("found …").
[[nodiscard]] tl::unexpected<Core::Error> Refuse(
    EPlanningError error,
    const std::string& path,
    std::string expected,
    std::string found);

/// EPlanningError::StoreFailed.
[[nodiscard]] tl::unexpected<Core::Error> Refuse(const std::string& path, std::string expected, std::string found);

/// For an exception of SQLite during an operation ("writing"). The system's error number is 0 where it is not known.
[[nodiscard]] tl::unexpected<Core::Error> RefuseFor(
    const SQLite::Exception& exception,
    const std::string& path,
    std::string_view operation,
    int systemError);

[[nodiscard]] std::string DescribeErrno(int reason);

} // namespace ACS::Planning
