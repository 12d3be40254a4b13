#include "MosquittoError.hpp"

#include <mosquitto.h>

namespace ACS::VDA5050
{
namespace
{

class MosquittoCategory final : public std::error_category
{
public:
    [[nodiscard]] const char* name() const noexcept override
    {
        return "mosquitto";
    }

    [[nodiscard]] std::string message(int code) const override
    {
        std::string text = mosquitto_strerror(code);
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
    if (returnCode == CONNACK_BAD_LOGIN || returnCode == CONNACK_NOT_AUTHORISED)
    {
        return MakeMosquittoError(MOSQ_ERR_AUTH, 0);
    }
    return MakeMosquittoError(MOSQ_ERR_CONN_REFUSED, 0);
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
