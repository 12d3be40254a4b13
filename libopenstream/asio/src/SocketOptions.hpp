#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/socket_base.hpp>

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <sys/ioctl.h>
#include <sys/socket.h>

#ifdef __linux__
#include <linux/sockios.h>
#endif

namespace ACS::OpenStreamAsio
{

/// What both ends want of a connection. A system that does not know an option goes without it.
inline void SetSocketOptions(boost::asio::ip::tcp::socket& socket)
{
    boost::system::error_code ignored;
    static_cast<void>(socket.set_option(boost::asio::ip::tcp::no_delay(true), ignored));
    static_cast<void>(socket.set_option(boost::asio::socket_base::keep_alive(true), ignored));
}

/// Discards unsent data when the connection is closed, also at the end of the process. By default the system could deliver
/// a command minutes later, when the network or the peer has recovered.
inline void DropUnsentAtClose(boost::asio::ip::tcp::socket& socket)
{
    boost::system::error_code ignored;
    static_cast<void>(socket.set_option(boost::asio::socket_base::linger(true, 0), ignored));
}

/// If all data has arrived, as far as the system knows, the peer sees an orderly close and no error.
inline void CloseInPeaceWhenAllArrived(boost::asio::ip::tcp::socket& socket)
{
#ifdef SIOCOUTQ
    int left = 0;
    if (ioctl(socket.native_handle(), SIOCOUTQ, &left) == 0 && left == 0)
    {
        boost::system::error_code ignored;
        static_cast<void>(socket.set_option(boost::asio::socket_base::linger(false, 0), ignored));
    }
#else
    static_cast<void>(socket);
#endif
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
