#pragma once

#include <string>
#include <system_error>

namespace ACS::VDA5050
{

/// A MOSQ_ERR_… code as an error code with libmosquitto's own text; MOSQ_ERR_ERRNO becomes the system's error.
/// Zero is no error.
[[nodiscard]] std::error_code MakeMosquittoError(int code, int systemError);

/// What the broker answered to CONNECT, 1 to 5 of MQTT 3.1.1: 4 and 5 are MOSQ_ERR_AUTH, others MOSQ_ERR_CONN_REFUSED.
[[nodiscard]] std::error_code MakeConnackError(int returnCode);

/// What a person can do about it, as the end of a sentence.
[[nodiscard]] std::string MakeConnectAdvice(const std::error_code& reason);

} // namespace ACS::VDA5050
