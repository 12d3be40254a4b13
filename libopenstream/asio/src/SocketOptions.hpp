#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/socket_base.hpp>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/socket.h>

namespace ACS::OpenStreamAsio
{

/// What both ends want of a connection. A system that does not know an option goes without it.
inline void SetSocketOptions(boost::asio::ip::tcp::socket& socket)
{
    boost::system::error_code ignored;
    static_cast<void>(socket.set_option(boost::asio::ip::tcp::no_delay(true), ignored));
    static_cast<void>(socket.set_option(boost::asio::socket_base::keep_alive(true), ignored));
}

/// Until the next write, where the system has it.
inline void SetQuickAcknowledgement(boost::asio::ip::tcp::socket& socket)
{
#ifdef TCP_QUICKACK
    const int on = 1;
    static_cast<void>(setsockopt(socket.native_handle(), IPPROTO_TCP, TCP_QUICKACK, &on, sizeof on));
#else
    static_cast<void>(socket);
#endif
}

} // namespace ACS::OpenStreamAsio
