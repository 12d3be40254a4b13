#pragma once

#include "common/Endpoint.hpp"
#include <acs/core/Result.hpp>

#include <boost/asio/ip/tcp.hpp>

namespace ACS::Apps
{

/// Opens, binds and listens, on a name or an address. The result is the same host with the port that was got; the
/// error names the address and what to do. Looks a host name up, which may block: for the start of a program.
[[nodiscard]] Core::Result<Endpoint> ListenOn(boost::asio::ip::tcp::acceptor& acceptor, const Endpoint& endpoint);

} // namespace ACS::Apps
