#pragma once

#include "common/config/Endpoint.hpp"

#include <boost/asio/ip/address.hpp>
#include <boost/asio/ip/tcp.hpp>

namespace ACS::Apps
{

/// The peer's address and port; the unspecified address if the connection is already gone.
[[nodiscard]] Endpoint GetPeer(const boost::asio::ip::tcp::socket& socket);

/// What counts as one peer: an IPv4 address, also one that is mapped to IPv6; of an IPv6 address its /64, which one host can
/// have as a whole. The unspecified address if the connection is already gone.
[[nodiscard]] boost::asio::ip::address GetPeerGroup(const boost::asio::ip::tcp::socket& socket);

/// The same for an address.
[[nodiscard]] boost::asio::ip::address GetPeerGroup(const boost::asio::ip::address& address);

} // namespace ACS::Apps
