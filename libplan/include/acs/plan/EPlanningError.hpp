#pragma once

#include <acs/core/Api.hpp>

#include <system_error>

namespace ACS::Planning
{

/// Errors of maps, options and stores. The numbers are stable: they appear in logs and metrics.
enum class EPlanningError
{
    InvalidSite = 1,         ///< Inconsistent map: a duplicate id, or an edge or a station with an unknown node.
    InvalidOptions = 2,      ///< Options that contradict the map or each other.
    StoreFailed = 3,         ///< The store could not be read or written (disk full, no permission, …).
    StoreCorrupt = 4,        ///< A file of the store is damaged or of another kind.
    StoreTooNew = 5,         ///< The store was written by a newer version.
    StoreTaken = 6,          ///< Another program uses the store, or has taken the path of one that is open.
    StoreOutcomeUnknown = 7, ///< A commit failed after it was written: the next start may find it.
};

/// Makes the enumerators convertible to std::error_code.
[[nodiscard]] ACS_API std::error_code make_error_code(EPlanningError error) noexcept;

} // namespace ACS::Planning

template <>
struct std::is_error_code_enum<ACS::Planning::EPlanningError> : std::true_type
{
};
