#pragma once

#include <acs/protocol/AcsMessage.hpp>

#include <chrono>
#include <string_view>

namespace ACS::Acsd
{

/// The functions of AcsSession that McsGateway calls. They are executed at once; the session's resulting events follow after
/// the call has returned.
class IMcsOutput
{
public:
    IMcsOutput() = default;
    IMcsOutput(const IMcsOutput&) = delete;
    IMcsOutput& operator=(const IMcsOutput&) = delete;
    virtual ~IMcsOutput() = default;

    [[nodiscard]] virtual bool IsRegistered() const = 0;
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
    virtual void SetSiteOffset(std::chrono::minutes offset) = 0;
};

} // namespace ACS::Acsd
