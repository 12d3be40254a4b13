#pragma once

#include <acs/core/Backoff.hpp>
#include <acs/vda5050/IMqttLink.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

namespace ACS::VDA5050
{

/// An encrypted connection (mqtts). Paths of PEM files, read anew at each connect.
struct MosquittoTls
{
    std::string caFile;   ///< Whose certificates are trusted; empty: the system's.
    std::string certFile; ///< Our own certificate; empty: none.
    std::string keyFile;  ///< Its key, not encrypted; given exactly if certFile is.
};

enum class EMqttVersion : std::uint8_t
{
    Version311,
    Version5,
};

struct MosquittoOptions
{
    EMqttVersion version = EMqttVersion::Version311;
    std::string host = "127.0.0.1"; ///< A name or an address (IPv6 without brackets).
    std::uint16_t port = 1883;
    std::string clientID; ///< Unique on the broker; empty: the broker or the library makes one (clean session only).
    std::chrono::seconds keepAlive{15}; ///< At least 5 s. After 1.5 times this the broker sends the will.
    std::string username;               ///< Empty: none.
    std::string password;
    std::optional<MosquittoTls> tls;
    /// False: the broker keeps the subscriptions, and what comes for them with QoS 1 or 2, while there is no connection;
    /// and what was published with QoS 1 or 2 is sent again until it is acknowledged, a message of QoS 2 exactly once,
    /// both ways, however often the connection breaks. As long as the link and the broker's session live. Needs a client
    /// id.
    bool bCleanSession = true;
    std::chrono::seconds sessionExpiry{
        86'400};                  ///< How long MQTT 5 keeps such a session; 3.1.1 leaves it to the broker.
    std::optional<MqttWill> will; ///< See also MosquittoLink::SetWill.
    Core::BackoffOptions backoff; ///< Between attempts to connect.
    std::chrono::milliseconds connectTimeout{10'000}; ///< From the attempt to the last answer to a subscription.
    /// Messages that may wait for the socket or for the broker's acknowledgement; one more is refused (QueueFull).
    std::size_t maxUnsent = 1'000;
    /// Messages that may come in before the broker has answered all subscriptions, and the bytes of their topics and
    /// payloads; more are dropped, with a word in the log.
    std::size_t maxEarly = 10'000;
    std::size_t maxEarlyBytes = 64U << 20U;
    /// A longer payload that comes in is dropped before it is copied, with a word in the log.
    std::size_t maxPayloadBytes = 4U << 20U;
};

} // namespace ACS::VDA5050
