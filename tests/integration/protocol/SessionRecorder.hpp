#pragma once

#include <acs/protocol/SessionEvent.hpp>
#include <acs/protocol_beast/ISessionHandler.hpp>

#include <functional>
#include <string>
#include <variant>
#include <vector>

namespace ACS::Testing
{

/// Records the events and calls a function of the test for each.
class SessionRecorder final : public ProtocolBeast::ISessionHandler
{
public:
    std::vector<Protocol::SessionEvent> events;
    std::function<void(const Protocol::SessionEvent&)> onEvent;

    void OnSessionEvent(const Protocol::SessionEvent& event) override
    {
        events.push_back(event);
        if (onEvent)
        {
            onEvent(event);
        }
    }

    template <typename TEvent>
    [[nodiscard]] std::vector<TEvent> GetAll() const
    {
        std::vector<TEvent> found;
        for (const Protocol::SessionEvent& event : events)
        {
            if (const TEvent* eventOrNull = std::get_if<TEvent>(&event))
            {
                found.push_back(*eventOrNull);
            }
        }
        return found;
    }

    /// Why the first link was lost; empty without a loss.
    [[nodiscard]] std::string GetFirstLoss() const
    {
        const auto losses = GetAll<Protocol::LinkLost>();
        return losses.empty() ? std::string() : losses.front().reason;
    }
};

} // namespace ACS::Testing
