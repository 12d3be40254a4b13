#pragma once

#include <acs/vda5050/IMqttLink.hpp>

#include <cstddef>
#include <vector>

namespace ACS::VDA5050
{

/// Messages that come before the link is up, in limited number: a broker sends retained ones, and those of a persistent session, at
/// once. Pure.
class EarlyMessages final
{
public:
    struct Limits
    {
        std::size_t maxCount = 0;
        std::size_t maxBytes = 0; ///< Topics and payloads.
    };

private:
    Limits _limits;
    std::vector<MqttMessage> _messages;
    std::size_t _bytes = 0;
    std::size_t _dropped = 0; ///< Of the present connection.

public:
    explicit EarlyMessages(const Limits& limits) noexcept;

    /// Another connection begins. bKept: those of the former one are still delivered.
    void OnAttempt(bool bKept);

    /// Drops a message that is beyond a limit.
    void Add(const MqttMessage& message);

    [[nodiscard]] std::size_t GetDropped() const noexcept;

    /// In their order.
    [[nodiscard]] std::vector<MqttMessage> TakeAll();
};

} // namespace ACS::VDA5050
