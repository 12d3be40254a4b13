#pragma once

#include <acs/core/Backoff.hpp>
#include <acs/vda5050/IMqttLink.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace ACS::VDA5050
{

/// TLS (mqtts). Paths of PEM files, which are read at each connect.
struct MosquittoTLS
{
    std::string caFile;   ///< Trusted CAs; empty: the system's.
    std::string certFile; ///< Client certificate; empty: none.
    std::string keyFile;  ///< Its private key, without a passphrase; required with certFile.
};

/// Where a broker listens.
struct MosquittoBroker
{
    std::string host;          ///< A name or an address (IPv6 without brackets).
    std::uint16_t port = 1883; ///< 8883 is usual with TLS.

    bool operator==(const MosquittoBroker&) const = default;
};

/// Version of MQTT.
enum class EMqttVersion : std::uint8_t
{
    Version311,
    Version5,
};

/// Broker, session and limits of a MosquittoLink.
struct MosquittoOptions
{
    EMqttVersion version = EMqttVersion::Version311; ///< What the link speaks; the broker must too.
    std::string host = "127.0.0.1";                  ///< A name or an address (IPv6 without brackets).
    std::uint16_t port = 1883;                       ///< 8883 is usual with TLS.
    /// Further nodes of the broker's cluster. A lost connection and a failed attempt lead to the next node in the order host,
    /// furtherBrokers, host and so on. All of them have the same accounts, and TLS or not.
    std::vector<MosquittoBroker> furtherBrokers{};
    /// Highest quality of service that the broker supports: messages and subscriptions with a higher one are lowered to it.
    std::uint8_t maxQos = 2;
    std::string clientID;               ///< Unique on the broker; empty: generated (clean session only).
    std::chrono::seconds keepAlive{15}; ///< At least 5 s. The broker sends the will after 1.5 times this.
    std::string username;               ///< Empty: none.
    std::string password;               ///< Without effect if username is empty.
    std::optional<MosquittoTLS> tls;    ///< Absent: a connection without encryption.
    /// False: a persistent session, which needs a clientID. While there is no connection, the broker keeps the subscriptions
    /// and their messages of QoS 1 and 2. Published messages of QoS 1 and 2 are resent until they are acknowledged; those of
    /// QoS 2 are delivered exactly once in both directions, for the lifetime of the link and of the broker's session.
    bool bCleanSession = true;
    std::chrono::seconds sessionExpiry{86'400}; ///< Of a persistent session in MQTT 5; in 3.1.1 the broker decides.
    std::optional<MqttWill> will;               ///< See also MosquittoLink::SetWill.
    Core::BackoffOptions
        backoff; ///< Between connection attempts; with several brokers the delay grows when all have failed.
    std::chrono::milliseconds connectTimeout{
        10'000}; ///< Until the broker has confirmed the first, or one more, subscription.
    /// Maximum number of messages that wait for the socket or for the broker's acknowledgement; then QueueFull.
    std::size_t maxUnsent = 1'000;
    /// Maximum number of messages before all subscriptions are confirmed, and of the bytes of their topics and payloads; more
    /// are dropped and logged.
    std::size_t maxEarly = 10'000;
    std::size_t maxEarlyBytes = 64U << 20U; ///< See maxEarly.
    /// Longer received payloads are dropped and logged.
    std::size_t maxPayloadBytes = 4U << 20U;
    /// Asked on the executor before anything is sent, also what waits since an earlier call: false closes the connection instead. For
    /// a program that may command for a time only. May be empty: it may always send.
    std::function<bool()> maySend{};
};

} // namespace ACS::VDA5050
