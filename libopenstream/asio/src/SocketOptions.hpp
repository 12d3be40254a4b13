#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/socket_base.hpp>

namespace ACS::OpenStreamAsio
{

/// What both ends want of a connection. A system that does not know an option goes without it.
inline void SetSocketOptions(boost::asio::ip::tcp::socket& socket)
{
    boost::system::error_code ignored;
    static_cast<void>(socket.set_option(boost::asio::ip::tcp::no_delay(true), ignored));
    static_cast<void>(socket.set_option(boost::asio::socket_base::keep_alive(true), ignored));
}

} // namespace ACS::OpenStreamAsio
