#include "TlsTransport.hpp"

#include "BeastLink.hpp"
#include "TlsContext.hpp"
#include "TlsFailure.hpp"
#include "UpgradeGate.hpp"

#include <boost/asio/ssl.hpp>
#include <boost/beast/websocket/ssl.hpp>

#include <string>
#include <utility>

namespace ACS::ProtocolBeast
{

namespace
{

namespace ssl = boost::asio::ssl;

struct TlsLayer
{
    using Stream = ssl::stream<boost::beast::tcp_stream>;
    using ErrorCode = boost::beast::error_code;

    template <typename THandler>
    static void HandshakeAsync(Stream& stream, THandler handler)
    {
        const bool bServer = SSL_is_server(stream.native_handle()) != 0;
        stream.async_handshake(bServer ? ssl::stream_base::server : ssl::stream_base::client, std::move(handler));
    }

    [[nodiscard]] static std::string Describe(Stream& stream, ErrorCode error)
    {
        return DescribeTlsFailure(stream.native_handle(), error);
    }

    [[nodiscard]] static std::string GetPeerSubject(Stream& stream)
    {
        return ProtocolBeast::GetPeerSubject(stream.native_handle());
    }
};

class TlsTransport final : public ITransport
{
    ssl::context _context;
    std::string _serverName; ///< Asked for in the handshake; empty where it is an address, or on a server.

public:
    TlsTransport(ssl::context context, std::string serverName)
        : _context(std::move(context)),
          _serverName(std::move(serverName))
    {
    }

    [[nodiscard]] std::shared_ptr<ILink> MakeClientLink(
        const boost::asio::any_io_executor& executor,
        const LinkOptions& options,
        LinkOwner owner) override
    {
        TlsLayer::Stream stream(boost::beast::tcp_stream(executor), _context);
        SetRequestedName(stream.native_handle(), _serverName);
        return std::make_shared<BeastLink<TlsLayer>>(std::move(stream), options, std::move(owner));
    }

    [[nodiscard]] std::shared_ptr<IGate> MakeGate(
        boost::asio::ip::tcp::socket socket,
        const LinkOptions& options,
        GateOwner owner) override
    {
        TlsLayer::Stream stream(boost::beast::tcp_stream(std::move(socket)), _context);
        return std::make_shared<UpgradeGate<TlsLayer>>(std::move(stream), options, std::move(owner));
    }
};

} // namespace

Core::Result<std::unique_ptr<ITransport>> MakeTlsClientTransport(const TlsOptions& options, std::string_view host)
{
    Core::Result<ssl::context> context = MakeClientContext(options, host);
    if (!context.has_value())
    {
        return tl::unexpected<Core::Error>(std::move(context.error()));
    }
    return std::make_unique<TlsTransport>(std::move(*context), GetRequestedName(options, host));
}

Core::Result<std::unique_ptr<ITransport>> MakeTlsServerTransport(const TlsOptions& options)
{
    Core::Result<ssl::context> context = MakeServerContext(options);
    if (!context.has_value())
    {
        return tl::unexpected<Core::Error>(std::move(context.error()));
    }
    return std::make_unique<TlsTransport>(std::move(*context), std::string());
}

} // namespace ACS::ProtocolBeast
