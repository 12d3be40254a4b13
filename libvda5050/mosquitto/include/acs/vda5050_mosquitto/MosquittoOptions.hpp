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

struct MosquittoOptions
{
    std::string host = "127.0.0.1"; ///< A name or an address (IPv6 without brackets).
    std::uint16_t port = 1883;
    std::string clientID; ///< Unique on the broker; empty: the broker or the library makes one (clean session only).
    std::chrono::seconds keepAlive{15}; ///< At least 5 s. After 1.5 times this the broker sends the will.
    std::string username;               ///< Empty: none.
    std::string password;
    std::optional<MosquittoTls> tls;
    bool bCleanSession = true;
    std::optional<MqttWill> will;                     ///< See also MosquittoLink::SetWill.
    Core::BackoffOptions backoff;                     ///< Between attempts to connect.
    std::chrono::milliseconds connectTimeout{10'000}; ///< From the attempt to the broker's acceptance.
    std::size_t maxUnsent = 1'000; ///< Messages that may wait for the socket or for the broker's acknowledgement.
};

} // namespace ACS::VDA5050
