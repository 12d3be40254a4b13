#include "MosquittoError.hpp"

#include <mosquitto.h>

#include <algorithm>
#include <array>
#include <mqtt_protocol.h>

namespace ACS::VDA5050
{
namespace
{

constexpr int FIRST_REASON = 0x80; ///< From here on the reasons of MQTT 5; libmosquitto's own codes are smaller.

class MosquittoCategory final : public std::error_category
{
public:
    [[nodiscard]] const char* name() const noexcept override
    {
        return "mosquitto";
    }

    [[nodiscard]] std::string message(int code) const override
    {
        std::string text = code >= FIRST_REASON ? mosquitto_reason_string(code) : mosquitto_strerror(code);
        while (text.ends_with('.'))
        {
            text.pop_back();
        }
        return text;
    }
};

const std::error_category& GetMosquittoCategory()
{
    static const MosquittoCategory CATEGORY;
    return CATEGORY;
}

constexpr int CONNACK_BAD_LOGIN = 4;
constexpr int CONNACK_NOT_AUTHORISED = 5;
constexpr std::array LOGIN_REFUSALS{
    CONNACK_BAD_LOGIN,
    CONNACK_NOT_AUTHORISED,
    static_cast<int>(MQTT_RC_BAD_USERNAME_OR_PASSWORD),
    static_cast<int>(MQTT_RC_NOT_AUTHORIZED)};

} // namespace

std::error_code MakeMosquittoError(int code, int systemError)
{
    if (code == MOSQ_ERR_SUCCESS)
    {
        return {};
    }
    if (code == MOSQ_ERR_ERRNO && systemError != 0)
    {
        return {systemError, std::system_category()};
    }
    return {code, GetMosquittoCategory()};
}

std::error_code MakeConnackError(int returnCode)
{
    if (std::ranges::find(LOGIN_REFUSALS, returnCode) != LOGIN_REFUSALS.end())
    {
        return MakeMosquittoError(MOSQ_ERR_AUTH, 0);
    }
    return MakeMosquittoError(returnCode >= FIRST_REASON ? returnCode : MOSQ_ERR_CONN_REFUSED, 0);
}

bool IsSessionTakenOver(const std::error_code& reason)
{
    return reason.category() == GetMosquittoCategory() && reason.value() == MQTT_RC_SESSION_TAKEN_OVER;
}

std::string MakeConnectAdvice(const std::error_code& reason)
{
    if (reason.category() != GetMosquittoCategory())
    {
        return "start it or correct its address";
    }
    switch (reason.value())
    {
        case MOSQ_ERR_AUTH:
        case MOSQ_ERR_CONN_REFUSED:
            return "check user name, password and client id";
        case MOSQ_ERR_TLS:
        case MOSQ_ERR_TLS_HANDSHAKE:
        case MOSQ_ERR_INVAL:
            return "check the certificates and whether it speaks TLS on this port";
        case MOSQ_ERR_EAI:
        case MOSQ_ERR_LOOKUP:
            return "check the name of its host";
        default:
            return "start it or correct its address";
    }
}

} // namespace ACS::VDA5050
