#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <string_view>

struct mosquitto;

namespace ACS::VDA5050
{

/// A message of QoS 2 that came in, by its packet id.
struct ReceivedPublish
{
    int messageID = 0;
    int qos = 0;

    bool operator==(const ReceivedPublish&) const = default;
};

/// The received message in a line of libmosquitto's log; nullopt for other lines. libmosquitto reports a message of QoS 2 in
/// no other way before the broker has released it.
[[nodiscard]] std::optional<ReceivedPublish> ReadPublishLineOrNull(std::string_view line);

/// A client of libmosquitto with its incomplete message exchanges. A persistent session continues with the same client
/// after an outage: it resumes the exchanges with the broker and resends unanswered messages.
///
/// libmosquitto 2.0 does not recognise a message that the broker resends because its PUBREC was lost: it keeps the second
/// copy indefinitely, and would deliver it in place of a later message with the same packet id. Such a client is replaced as
/// soon as possible.
class MosquittoClient
{
    struct Deleter
    {
        void operator()(mosquitto* client) const;
    };

    std::unique_ptr<mosquitto, Deleter> _handle;
    std::set<int> _unacknowledged; ///< Sent with QoS 1 or 2.
    std::set<int> _halfReceived;   ///< With QoS 2, and not released by the broker.
    bool _bCopyLeft = false;

public:
    /// Takes the client.
    explicit MosquittoClient(mosquitto* client);

    /// Null only where the object was moved from.
    [[nodiscard]] mosquitto* GetHandleOrNull() const noexcept;

    void OnSending(int messageID);
    /// Whether it was one with QoS 1 or 2.
    bool TryAcknowledge(int messageID);
    [[nodiscard]] std::size_t CountUnacknowledged() const noexcept;

    void OnPublishCame(int messageID);
    void OnReleased(int messageID);

    /// Whether no exchange is incomplete, so that a new client would miss nothing.
    [[nodiscard]] bool IsQuiet() const noexcept;
    /// Whether it holds a second copy of a message.
    [[nodiscard]] bool IsSpoilt() const noexcept;
};

} // namespace ACS::VDA5050
