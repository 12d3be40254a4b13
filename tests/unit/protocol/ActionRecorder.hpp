#pragma once

#include "Catch.hpp"
#include <acs/protocol/AcsCodec.hpp>
#include <acs/protocol/SessionAction.hpp>

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Testing
{

/// Reads the actions of a session.
class ActionRecorder
{
    Protocol::AcsCodec _codec;

public:
    Protocol::SessionActions out;

    /// All actions of a kind since the last Clear.
    template <typename TAction>
    [[nodiscard]] std::vector<TAction> GetAll() const
    {
        std::vector<TAction> found;
        for (const Protocol::SessionAction& action : out)
        {
            if (const TAction* actionOrNull = std::get_if<TAction>(&action))
            {
                found.push_back(*actionOrNull);
            }
        }
        return found;
    }

    template <typename TEvent>
    [[nodiscard]] std::vector<TEvent> GetEvents() const
    {
        std::vector<TEvent> found;
        for (const Protocol::Deliver& deliver : GetAll<Protocol::Deliver>())
        {
            if (const TEvent* eventOrNull = std::get_if<TEvent>(&deliver.event))
            {
                found.push_back(*eventOrNull);
            }
        }
        return found;
    }

    [[nodiscard]] std::vector<Protocol::AcsMessage> GetMessages()
    {
        std::vector<Protocol::AcsMessage> found;
        for (const Protocol::SendText& send : GetAll<Protocol::SendText>())
        {
            Protocol::DecodeOutcome outcome = _codec.Decode(send.text);
            REQUIRE(outcome.message.has_value());
            REQUIRE(outcome.notes == Protocol::DecodeNotes{});
            found.push_back(std::move(*outcome.message));
        }
        return found;
    }

    /// The requests among the texts that were sent.
    [[nodiscard]] std::vector<Protocol::AcsRequest> GetRequests()
    {
        std::vector<Protocol::AcsRequest> found;
        for (Protocol::AcsMessage& message : GetMessages())
        {
            if (Protocol::AcsRequest* requestOrNull = std::get_if<Protocol::AcsRequest>(&message))
            {
                found.push_back(std::move(*requestOrNull));
            }
        }
        return found;
    }

    [[nodiscard]] std::vector<std::string> GetCommands()
    {
        std::vector<std::string> found;
        for (const Protocol::AcsRequest& request : GetRequests())
        {
            found.emplace_back(GetText(GetCommand(request)));
        }
        return found;
    }

    [[nodiscard]] std::vector<Protocol::AcsAck> GetAcks()
    {
        std::vector<Protocol::AcsAck> found;
        for (Protocol::AcsMessage& message : GetMessages())
        {
            if (Protocol::AcsAck* ackOrNull = std::get_if<Protocol::AcsAck>(&message))
            {
                found.push_back(std::move(*ackOrNull));
            }
        }
        return found;
    }

    [[nodiscard]] std::vector<Protocol::EProtocolNote> GetNotes() const
    {
        std::vector<Protocol::EProtocolNote> found;
        for (const Protocol::ProtocolNoted& noted : GetEvents<Protocol::ProtocolNoted>())
        {
            found.push_back(noted.what);
        }
        return found;
    }

    /// The delay of a timer that was started since the last Clear; nullopt where it was not.
    [[nodiscard]] std::optional<std::chrono::milliseconds> GetDelayOrNull(Protocol::ESessionTimer timer) const
    {
        std::optional<std::chrono::milliseconds> delay;
        for (const Protocol::StartTimer& start : GetAll<Protocol::StartTimer>())
        {
            if (start.timer == timer)
            {
                delay = start.delay;
            }
        }
        return delay;
    }

    void Clear()
    {
        out.clear();
    }
};

} // namespace ACS::Testing
