#pragma once

#include "RawPeer.hpp"
#include "WebSocketFixture.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/protocol/AcsCodec.hpp>

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace ACS::Testing
{

using Protocol::EAcsCommand;

inline std::string Encode(const Protocol::AcsMessage& message)
{
    std::string text;
    Protocol::AcsCodec::Encode(message, text);
    return text;
}

/// Reads also the long texts that fill a socket.
inline Protocol::CodecOptions MakeCodecOptions()
{
    Protocol::CodecOptions options;
    options.maximumString = options.maximumBytes;
    return options;
}

/// A raw MCS on one connection: records what it receives, and acknowledges it on demand.
class RawMCS
{
    RawPeer& _peer;
    Protocol::AcsCodec _codec{MakeCodecOptions()};

public:
    std::vector<Protocol::AcsRequest> requests;
    std::vector<Protocol::AcsAck> acks;
    std::vector<RawFrame> closes;
    /// Returns whether to acknowledge the request; may also act on the connection.
    std::function<bool(const Protocol::AcsRequest& request)> onRequest;
    bool bKeepsOpen = false; ///< The TCP connection, after a close frame.

    explicit RawMCS(RawPeer& peer)
        : _peer(peer)
    {
        peer.onChange = [this] {
            OnChange();
        };
        peer.ReadAsync();
    }

    void Send(const std::string& text, EFrame kind = EFrame::Text, bool bFinal = true)
    {
        _peer.Write(MakeFrame({kind, text, bFinal}, false));
    }

    [[nodiscard]] std::vector<EAcsCommand> GetCommands() const
    {
        std::vector<EAcsCommand> commands;
        for (const Protocol::AcsRequest& request : requests)
        {
            commands.push_back(GetCommand(request));
        }
        return commands;
    }

    [[nodiscard]] std::size_t Count(EAcsCommand command) const
    {
        std::size_t count = 0;
        for (const Protocol::AcsRequest& request : requests)
        {
            count += GetCommand(request) == command ? 1U : 0U;
        }
        return count;
    }

    [[nodiscard]] RawPeer& GetPeer()
    {
        return _peer;
    }

private:
    void OnChange()
    {
        if (!_peer.TryUpgrade())
        {
            return;
        }
        for (std::optional<RawFrame> frame = _peer.TakeFrameOrNull(); frame.has_value();
             frame = _peer.TakeFrameOrNull())
        {
            if (frame->kind == EFrame::Close)
            {
                closes.push_back(*frame);
                if (!bKeepsOpen)
                {
                    _peer.Close(); // as a server does it, first
                }
            }
            else if (frame->kind == EFrame::Text)
            {
                CHECK(frame->bFinal); // one unfragmented frame per message
                OnText(frame->payload);
            }
        }
    }

    void OnText(const std::string& text)
    {
        const Protocol::DecodeOutcome outcome = _codec.Decode(text);
        REQUIRE(outcome.message.has_value());
        std::visit(
            Core::Overloaded{
                [this](const Protocol::AcsAck& ack) { acks.push_back(ack); },
                [this](const Protocol::AcsRequest& request) {
                    OnRequest(request);
                }},
            *outcome.message);
    }

    void OnRequest(const Protocol::AcsRequest& request)
    {
        requests.push_back(request);
        const bool bAcknowledged = onRequest ? onRequest(request) : true;
        if (bAcknowledged && GetCommand(request) != EAcsCommand::RobotPositionUpdate)
        {
            Send(Encode(Protocol::AcsAck{GetCommand(request), request.transactionID, request.timestamp, {}, {}, {}}));
        }
    }
};

} // namespace ACS::Testing
