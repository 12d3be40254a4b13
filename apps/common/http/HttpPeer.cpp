#include "common/http/HttpPeer.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

namespace ACS::Apps
{

Endpoint GetPeer(const boost::asio::ip::tcp::socket& socket)
{
    boost::system::error_code error;
    const boost::asio::ip::tcp::endpoint endpoint = socket.remote_endpoint(error);
    return {endpoint.address().to_string(), endpoint.port()};
}

boost::asio::ip::address GetPeerGroup(const boost::asio::ip::tcp::socket& socket)
{
    boost::system::error_code error;
    return GetPeerGroup(socket.remote_endpoint(error).address());
}

boost::asio::ip::address GetPeerGroup(const boost::asio::ip::address& address)
{
    if (address.is_v4())
    {
        return address;
    }
    if (address.to_v6().is_v4_mapped())
    {
        return boost::asio::ip::make_address_v4(boost::asio::ip::v4_mapped, address.to_v6());
    }
    constexpr std::size_t PREFIX_BYTES = 8;
    boost::asio::ip::address_v6::bytes_type bytes = address.to_v6().to_bytes();
    std::fill(bytes.begin() + PREFIX_BYTES, bytes.end(), std::uint8_t{0});
    return boost::asio::ip::address_v6(bytes);
}

} // namespace ACS::Apps
