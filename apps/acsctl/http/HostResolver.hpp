#pragma once

#include "common/config/Endpoint.hpp"
#include "http/EventLoop.hpp"

#include <boost/asio/ip/tcp.hpp>
#include <boost/system/error_code.hpp>
#include <tl/expected.hpp>

#include <chrono>
#include <memory>

namespace ACS::Acsctl
{

/// Resolves the name of one host. A thread asks the name server, which may not answer: the thread may outlive this object and the
/// program. Its answer is used by the next call if this one has ended before.
class HostResolver final
{
public:
    using Addresses = boost::asio::ip::tcp::resolver::results_type;

private:
    class Lookup;

    EventLoop& _loop;
    const Apps::Endpoint _host;
    std::shared_ptr<Lookup> _lookupOrNull; ///< Its answer is not used yet.

public:
    /// The loop must outlive it.
    HostResolver(EventLoop& loop, Apps::Endpoint host);

    /// Waits at most this time; less after an interrupt. Without an answer the error is boost::beast::error::timeout.
    [[nodiscard]] tl::expected<Addresses, boost::system::error_code> Resolve(std::chrono::milliseconds timeout);
};

} // namespace ACS::Acsctl
