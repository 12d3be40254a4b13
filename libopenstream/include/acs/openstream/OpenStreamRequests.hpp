#pragma once

#include <acs/core/JsonText.hpp>
#include <acs/openstream/EApiMethod.hpp>
#include <acs/openstream/EOpenStreamCommand.hpp>
#include <acs/openstream/EStopTarget.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace ACS::OpenStream
{

inline constexpr std::int64_t PROTOCOL_MAJOR = 1;             ///< The version of the protocol that the library speaks.
inline constexpr std::chrono::milliseconds MINIMUM_PERIOD{2}; ///< Of a MONITOR.
inline constexpr std::chrono::milliseconds MAXIMUM_PERIOD{30'000}; ///< Of a MONITOR.
inline constexpr std::size_t LONGEST_URL = 2048;                   ///< Bytes, after JSON decoding.
inline constexpr std::size_t LONGEST_LINE = 1024U * 1024U; ///< Bytes of a line without its end, in both directions.
inline constexpr std::size_t LONGEST_ID = 256;             ///< Bytes of a MONITOR's id as JSON: each line repeats it.
inline constexpr std::size_t DEEPEST_NESTING = 64;         ///< Objects and arrays of a line within each other.

/// HANDSHAKE: the first command of a session.
struct HandshakeRequest
{
    std::int64_t major = PROTOCOL_MAJOR; ///< 0 or more; clamped to 64 bits.

    bool operator==(const HandshakeRequest&) const = default;
};

/// MONITOR: repeats a GET at a period until STOP or another MONITOR.
struct MonitorRequest
{
    std::string url; ///< Begins with '/', no blank or control character, at most LONGEST_URL bytes.
    std::chrono::milliseconds period{MINIMUM_PERIOD}; ///< The codec clamps it to MINIMUM_PERIOD … MAXIMUM_PERIOD.
    std::optional<Core::JsonText> args;               ///< An object; added to the query.
    std::optional<Core::JsonText>
        id; ///< A number or a string of at most LONGEST_ID, which every data line repeats. Other values are ignored.

    bool operator==(const MonitorRequest&) const = default;
};

/// CONTROL: one call. A failure is answered with a ControlError, success is not answered.
struct ControlRequest
{
    EApiMethod method = EApiMethod::Post; ///< Not Get.
    std::string url;                      ///< As in MonitorRequest.
    std::optional<Core::JsonText> args;   ///< An object; added to the query.
    std::optional<Core::JsonText> body;   ///< An object or an array; absent is `{}`.

    bool operator==(const ControlRequest&) const = default;
};

/// STOP: ends a MONITOR, the control of the robot, or the session.
struct StopRequest
{
    EStopTarget target = EStopTarget::Monitor; ///< What is stopped.

    bool operator==(const StopRequest&) const = default;
};

/// In the order of EOpenStreamCommand.
using OpenStreamRequest = std::variant<HandshakeRequest, MonitorRequest, ControlRequest, StopRequest>;

} // namespace ACS::OpenStream
