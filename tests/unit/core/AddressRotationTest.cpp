#include "Catch.hpp"
#include <acs/net/AddressRotation.hpp>

#include <boost/asio/ip/address.hpp>

#include <initializer_list>
#include <vector>

namespace ACS::Testing
{

namespace
{

using Endpoint = boost::asio::ip::tcp::endpoint;
using Endpoints = std::vector<Endpoint>;

const Endpoint& GetEndpoint(std::size_t index)
{
    static const Endpoints ENDPOINTS{
        {boost::asio::ip::make_address("192.0.2.1"), 7000},
        {boost::asio::ip::make_address("2001:db8::2"), 7000},
        {boost::asio::ip::make_address("192.0.2.3"), 7000}};
    return ENDPOINTS[index];
}

Endpoints MakeEndpoints(std::initializer_list<std::size_t> indexes)
{
    Endpoints endpoints;
    for (const std::size_t index : indexes)
    {
        endpoints.push_back(GetEndpoint(index));
    }
    return endpoints;
}

Net::HostLookup::Addresses MakeAddresses(std::initializer_list<std::size_t> indexes)
{
    const Endpoints endpoints = MakeEndpoints(indexes);
    return Net::HostLookup::Addresses::create(endpoints.begin(), endpoints.end(), "host", "7000");
}

} // namespace

TEST_CASE("An attempt to connect begins with the address after the last one tried")
{
    Net::AddressRotation rotation;
    const Net::HostLookup::Addresses found = MakeAddresses({0, 1, 2});
    const auto condition = rotation.MakeCondition();
    CHECK(rotation.Rotate(found) == MakeEndpoints({0, 1, 2}));
    CHECK(condition({}, GetEndpoint(0)));
    CHECK(rotation.Rotate(found) == MakeEndpoints({1, 2, 0}));
    CHECK(condition({}, GetEndpoint(1)));
    CHECK(rotation.Rotate(found) == MakeEndpoints({2, 0, 1}));
    CHECK(condition({}, GetEndpoint(2)));
    CHECK(rotation.Rotate(found) == MakeEndpoints({0, 1, 2}));
}

TEST_CASE("After a connection, or where the last address tried is gone, an attempt begins with the first address")
{
    Net::AddressRotation rotation;
    CHECK(rotation.MakeCondition()({}, GetEndpoint(1)));
    CHECK(rotation.Rotate(MakeAddresses({0, 2})) == MakeEndpoints({0, 2}));
    CHECK(rotation.Rotate(MakeAddresses({0, 1})) == MakeEndpoints({0, 1}));
    rotation.Reset();
    CHECK(rotation.Rotate(MakeAddresses({0, 1, 2})) == MakeEndpoints({0, 1, 2}));
    CHECK(rotation.Rotate({}).empty());
}

} // namespace ACS::Testing
