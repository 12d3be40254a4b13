#pragma once

#include "IGate.hpp"
#include "ILink.hpp"
#include <acs/protocol_beast/ClientOptions.hpp>

#include <boost/asio/any_io_executor.hpp>
#include <boost/asio/ip/tcp.hpp>

#include <memory>

namespace ACS::ProtocolBeast
{

/// Makes connections of one kind. The two kinds are compiled in one source each: Beast's templates take their time.
class ITransport
{
public:
    ITransport() = default;
    ITransport(const ITransport&) = delete;
    ITransport& operator=(const ITransport&) = delete;
    virtual ~ITransport() = default;

    [[nodiscard]] virtual std::shared_ptr<ILink> MakeClientLink(
        const boost::asio::any_io_executor& executor,
        const LinkOptions& options,
        LinkOwner owner) = 0;

    [[nodiscard]] virtual std::shared_ptr<IGate> MakeGate(
        boost::asio::ip::tcp::socket socket,
        const LinkOptions& options,
        GateOwner owner) = 0;
};

} // namespace ACS::ProtocolBeast
