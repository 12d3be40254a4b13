#pragma once

#include <string>
#include <system_error>

namespace ACS::VDA5050
{

/// A MOSQ_ERR_… code as an error code with libmosquitto's own text; MOSQ_ERR_ERRNO becomes the system's error.
/// Zero is no error.
[[nodiscard]] std::error_code MakeMosquittoError(int code, int systemError);

/// What the broker answered to CONNECT: a wrong login is MOSQ_ERR_AUTH; 1 to 3 of MQTT 3.1.1 are MOSQ_ERR_CONN_REFUSED,
/// a reason of MQTT 5 stays what it is.
[[nodiscard]] std::error_code MakeConnackError(int returnCode);

/// A word of MQTT 5: another client with the same id has connected.
[[nodiscard]] bool IsSessionTakenOver(const std::error_code& reason);

/// What a person can do about it, as the end of a sentence.
[[nodiscard]] std::string MakeConnectAdvice(const std::error_code& reason);

} // namespace ACS::VDA5050
