#pragma once

#include <acs/vda5050/IMqttLink.hpp>

#include <cstddef>
#include <string>
#include <system_error>

namespace ACS::VDA5050
{

/// Events of a MosquittoConnection, never sent during a call of it.
class IMosquittoConnectionOwner
{
public:
    IMosquittoConnectionOwner() = default;
    IMosquittoConnectionOwner(const IMosquittoConnectionOwner&) = delete;
    IMosquittoConnectionOwner& operator=(const IMosquittoConnectionOwner&) = delete;
    virtual ~IMosquittoConnectionOwner() = default;

    virtual void OnConnectionUp() = 0;
    virtual void OnConnectionMessage(const MqttMessage& message) = 0;
    /// A message was dropped because of its length.
    virtual void OnTooLong(const std::string& topic, std::size_t bytes) = 0;
    virtual void OnSent(int messageID) = 0;
    /// The broker has answered a Subscribe; the id is the one that it returned.
    virtual void OnSubscribed(int messageID, bool bGranted) = 0;
    /// The last call. Without a reason after Disconnect.
    virtual void OnConnectionClosed(std::error_code reason) = 0;
};

} // namespace ACS::VDA5050
