#pragma once

#include "common/config/Endpoint.hpp"
#include "http/EventLoop.hpp"
#include <acs/net/HostLookup.hpp>

#include <boost/system/error_code.hpp>
#include <tl/expected.hpp>

#include <chrono>

namespace ACS::Acsctl
{

/// Resolves the name of one host. An answer that comes too late is used by the next call.
class HostResolver final
{
public:
    using Addresses = Net::HostLookup::Addresses;

private:
    EventLoop& _loop;
    const Apps::Endpoint _host;
    Net::HostLookup _lookup;

public:
    /// The loop must outlive it.
    HostResolver(EventLoop& loop, Apps::Endpoint host);

    /// Waits at most this time; less after an interrupt. Without an answer the error is boost::beast::error::timeout.
    [[nodiscard]] tl::expected<Addresses, boost::system::error_code> Resolve(std::chrono::milliseconds timeout);
};

} // namespace ACS::Acsctl
