#pragma once

#include <acs/protocol/AcsMessage.hpp>

#include <string>
#include <string_view>

namespace ACS::AcsSim
{

/// The connection to the MCS: an AcsClient in the program.
class IAcsLink
{
public:
    IAcsLink() = default;
    IAcsLink(const IAcsLink&) = delete;
    IAcsLink& operator=(const IAcsLink&) = delete;
    virtual ~IAcsLink() = default;

    /// As the functions of AcsSession.
    [[nodiscard]] virtual bool TrySendDurable(const Protocol::AcsRequest& request) = 0;
    virtual void ReplayDone() = 0;
    virtual void SendStatus(const Protocol::AcsPayload& status) = 0;
    virtual void SendPosition(const Protocol::RobotPositionUpdate& positions) = 0;
    virtual void Answer(
        Protocol::EAcsCommand command,
        std::string_view transactionID,
        Protocol::EAckResult result,
        std::string_view message,
        const Protocol::AckPayload& payload) = 0;

    /// Past the session.
    virtual void SendText(const std::string& text) = 0;
    /// Breaks the connection without a closing handshake and connects again with a new session.
    virtual void Cut() = 0;
    virtual void Stop() = 0;
};

} // namespace ACS::AcsSim
