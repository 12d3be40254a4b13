#pragma once

#include <acs/net/HostLookup.hpp>

#include <boost/asio/ip/tcp.hpp>
#include <boost/system/error_code.hpp>

#include <algorithm>
#include <memory>
#include <optional>
#include <vector>

namespace ACS::Net
{

/// The order in which attempts to connect try the addresses of a host. One limit covers all addresses of an attempt, so one
/// that does not answer uses it up: the next attempt begins with the address after it.
class AddressRotation final
{
    using Endpoint = boost::asio::ip::tcp::endpoint;

    std::shared_ptr<std::optional<Endpoint>> _triedOrNull = std::make_shared<std::optional<Endpoint>>();

public:
    /// The addresses, beginning with the one after the last one tried.
    [[nodiscard]] std::vector<Endpoint> Rotate(const HostLookup::Addresses& found) const
    {
        std::vector<Endpoint> order(found.begin(), found.end());
        if (const auto tried = std::ranges::find(order, *_triedOrNull); tried != order.end())
        {
            std::rotate(order.begin(), tried + 1, order.end());
        }
        return order;
    }

    /// The condition of async_connect. May outlive this object.
    [[nodiscard]] auto MakeCondition() const
    {
        return [triedOrNull = _triedOrNull](const boost::system::error_code& /*error*/, const Endpoint& next) {
            *triedOrNull = next;
            return true;
        };
    }

    /// After a connection: the next attempt begins with the first address.
    void Reset()
    {
        _triedOrNull->reset();
    }
};

} // namespace ACS::Net
