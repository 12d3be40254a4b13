#include "common/TcpListen.hpp"

#include <boost/asio/error.hpp>
#include <boost/asio/socket_base.hpp>
#include <fmt/format.h>

namespace ACS::Apps
{

namespace
{

tl::unexpected<Core::Error> FailToListen(const Endpoint& endpoint, const boost::system::error_code& error)
{
    const std::error_code code = error;
    const bool bInUse = error == boost::asio::error::address_in_use;
    return Core::Fail(
        code,
        MakeText(endpoint),
        bInUse ? "a free port (stop the program that uses this one, or choose another; 0 takes any free port)"
               : "an address and port of this machine that this user may listen on",
        fmt::format("'{}'", error.message()));
}

boost::system::error_code Open(boost::asio::ip::tcp::acceptor& acceptor, const boost::asio::ip::tcp::endpoint& address)
{
    boost::system::error_code error;
    acceptor.open(address.protocol(), error);
    if (!error.failed())
    {
        acceptor.set_option(boost::asio::socket_base::reuse_address(true), error);
    }
    if (!error.failed())
    {
        acceptor.bind(address, error);
    }
    if (!error.failed())
    {
        acceptor.listen(boost::asio::socket_base::max_listen_connections, error);
    }
    return error;
}

} // namespace

Core::Result<Endpoint> ListenOn(boost::asio::ip::tcp::acceptor& acceptor, const Endpoint& endpoint)
{
    boost::system::error_code error;
    boost::asio::ip::tcp::resolver resolver(acceptor.get_executor());
    const auto addresses =
        resolver.resolve(endpoint.host, std::to_string(endpoint.port), boost::asio::ip::tcp::resolver::passive, error);
    if (error.failed() || addresses.empty())
    {
        return FailToListen(endpoint, error);
    }
    error = Open(acceptor, addresses.begin()->endpoint());
    if (error.failed())
    {
        boost::system::error_code ignored;
        acceptor.close(ignored);
        return FailToListen(endpoint, error);
    }
    return Endpoint{endpoint.host, acceptor.local_endpoint(error).port()};
}

} // namespace ACS::Apps
