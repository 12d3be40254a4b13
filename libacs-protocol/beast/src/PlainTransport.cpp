#include "PlainTransport.hpp"

#include "BeastLink.hpp"
#include "UpgradeGate.hpp"

#include <string>
#include <utility>

namespace ACS::ProtocolBeast
{

namespace
{

struct PlainLayer
{
    using Stream = boost::beast::tcp_stream;
    using ErrorCode = boost::beast::error_code;

    template <typename THandler>
    static void HandshakeAsync(Stream& /*stream*/, THandler handler)
    {
        handler(ErrorCode());
    }

    [[nodiscard]] static std::string Describe(Stream& /*stream*/, ErrorCode error)
    {
        return error.message();
    }

    [[nodiscard]] static std::string GetPeerSubject(Stream& /*stream*/)
    {
        return {};
    }
};

class PlainTransport final : public ITransport
{
public:
    [[nodiscard]] std::shared_ptr<ILink> MakeClientLink(
        const boost::asio::any_io_executor& executor,
        const LinkOptions& options,
        LinkOwner owner) override
    {
        return std::make_shared<BeastLink<PlainLayer>>(boost::beast::tcp_stream(executor), options, std::move(owner));
    }

    [[nodiscard]] std::shared_ptr<IGate> MakeGate(
        boost::asio::ip::tcp::socket socket,
        const LinkOptions& options,
        GateOwner owner) override
    {
        return std::make_shared<UpgradeGate<PlainLayer>>(
            boost::beast::tcp_stream(std::move(socket)),
            options,
            std::move(owner));
    }
};

} // namespace

std::unique_ptr<ITransport> MakePlainTransport()
{
    return std::make_unique<PlainTransport>();
}

} // namespace ACS::ProtocolBeast
