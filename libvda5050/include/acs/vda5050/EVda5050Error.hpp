#pragma once

#include <system_error>

namespace ACS::VDA5050
{

/// Why this library refuses a call or a message; what is wrong inside a payload is a Core::ECoreError with its path.
enum class EVda5050Error
{
    InvalidTopic = 1,       ///< Not interfaceName/v2/manufacturer/serialNumber/topic.
    UnsupportedVersion = 2, ///< A major version other than 2.
    InvalidOrder = 3,       ///< The order breaks a rule of its structure; it was not sent.
    VehicleNotReady = 4,    ///< Not online, no state yet, or a mode in which master control has no say.
    OrderActive = 5,        ///< Another order is not finished; cancel it or wait.
    NoOrder = 6,            ///< There is no order to update or to cancel.
    UpdatePending = 7,      ///< An update already waits until the one before is echoed.
    NotSupported = 8,       ///< The vehicle's factsheet has no such action, optional member or size; it was not sent.
};

[[nodiscard]] std::error_code make_error_code(EVda5050Error error) noexcept;

} // namespace ACS::VDA5050

template <>
struct std::is_error_code_enum<ACS::VDA5050::EVda5050Error> : std::true_type
{
};
