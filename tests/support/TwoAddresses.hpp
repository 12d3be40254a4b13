#pragma once

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include <cstdint>
#include <vector>

namespace ACS::Testing
{

/// A host with two addresses: 127.0.0.2, whose listener does not answer because its queue is full, and then 127.0.0.1. Link
/// acs_test_addresses, which resolves the name.
class TwoAddresses
{
public:
    static constexpr const char* HOST = "two-addresses.test";

private:
    using Tcp = boost::asio::ip::tcp;

    Tcp::acceptor _silent;
    std::vector<Tcp::socket> _waiting;

public:
    TwoAddresses(boost::asio::io_context& io, std::uint16_t port);
};

} // namespace ACS::Testing
