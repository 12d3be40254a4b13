#pragma once

#include <system_error>

namespace ACS::Planning
{

/// Errors of maps, configuration and stores. The numbers are stable: they appear in logs and metrics.
enum class EPlanningError
{
    InvalidSite = 1,    ///< A site map contradicts itself: an id twice, an edge or a station without its node.
    InvalidOptions = 2, ///< The configuration does not fit the site or itself.
    StoreFailed = 3,    ///< The store could not be read or written (disk full, no permission, …).
    StoreCorrupt = 4,   ///< The store's file is damaged or is something else.
    StoreTooNew = 5,    ///< The store was written by a newer version.
};

[[nodiscard]] std::error_code make_error_code(EPlanningError error) noexcept;

} // namespace ACS::Planning

template <>
struct std::is_error_code_enum<ACS::Planning::EPlanningError> : std::true_type
{
};
