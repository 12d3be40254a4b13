#pragma once

#include <acs/core/Api.hpp>

#include <system_error>

namespace ACS::VDA5050
{

/// Why a call or a message is refused. Errors inside a payload are a Core::ECoreError with its path.
enum class EVda5050Error
{
    InvalidTopic = 1,       ///< Not interfaceName/v2/manufacturer/serialNumber/topic.
    UnsupportedVersion = 2, ///< A major version other than 2.
    InvalidOrder = 3,       ///< The structure of the order is invalid; it was not sent.
    VehicleNotReady = 4,    ///< Not online, no state yet, or a mode without master control.
    OrderActive = 5,        ///< Another order is not finished; cancel it or wait.
    NoOrder = 6,            ///< There is no order to update or to cancel.
    UpdatePending = 7,      ///< An update waits already until the vehicle shows the previous one.
    NotSupported = 8,       ///< The vehicle's factsheet has no such action, optional member or size; it was not sent.
};

/// Makes the enumerators convertible to std::error_code.
[[nodiscard]] ACS_API std::error_code make_error_code(EVda5050Error error) noexcept;

} // namespace ACS::VDA5050

template <>
struct std::is_error_code_enum<ACS::VDA5050::EVda5050Error> : std::true_type
{
};
