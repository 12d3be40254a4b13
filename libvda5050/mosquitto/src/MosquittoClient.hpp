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

/// What one line of libmosquitto's log says, null where it is about something else. There is no other word from it about
/// a message of QoS 2 before the broker has released it.
[[nodiscard]] std::optional<ReceivedPublish> ReadPublishLineOrNull(std::string_view line);

/// A client of libmosquitto, with what it holds of messages that are half handed over. A persistent session goes on with
/// the same client after an outage: it answers the broker where it was interrupted, and sends again what was not answered.
///
/// libmosquitto 2.0 takes no notice of a message that it has already and that the broker sends again (its PUBREC was
/// lost): it keeps the second copy for ever, and would deliver it in the place of a later message with the same packet id.
/// So such a client is not used any longer than it must be.
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

    /// Nothing is half handed over: a new client would miss nothing.
    [[nodiscard]] bool IsQuiet() const noexcept;
    /// It holds a copy that nobody is to have.
    [[nodiscard]] bool IsSpoilt() const noexcept;
};

} // namespace ACS::VDA5050
