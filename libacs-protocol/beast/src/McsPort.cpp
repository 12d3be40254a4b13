#include "McsPort.Impl.hpp"
#include "PlainTransport.hpp"
#include "TlsTransport.hpp"

#include <boost/asio/ip/address.hpp>
#include <boost/system/error_code.hpp>

#include <algorithm>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::ProtocolBeast
{

namespace
{

constexpr unsigned HTTP_NOT_FOUND = 404;
constexpr unsigned HTTP_UPGRADE_REQUIRED = 426;
constexpr unsigned HTTP_UNAVAILABLE = 503;

std::string_view StripTarget(std::string_view target)
{
    target = target.substr(0, target.find_first_of("?#"));
    while (!target.empty() && target.back() == '/')
    {
        target.remove_suffix(1);
    }
    return target;
}

/// An IPv4 address in its own form, also on a socket for both kinds.
std::string GetText(const boost::asio::ip::address& address)
{
    namespace ip = boost::asio::ip;
    return address.is_v6() && address.to_v6().is_v4_mapped()
        ? ip::make_address_v4(ip::v4_mapped, address.to_v6()).to_string()
        : address.to_string();
}

} // namespace

McsPort::Impl::Impl(
    const boost::asio::any_io_executor& executor,
    const Core::Logger& logger,
    const PortOptions& options,
    std::unique_ptr<ITransport> transport)
    : _executor(executor),
      _logger(logger),
      _options(options),
      _transport(std::move(transport)),
      _listener(std::make_shared<Net::TcpListener>(executor, logger, [this](Tcp::socket socket) {
          OnAccepted(std::move(socket));
          return true;
      }))
{
}

Core::Result<void> McsPort::Impl::Listen()
{
    const Core::Result<std::uint16_t> port = _listener->Listen(_options.address, _options.port);
    if (!port.has_value())
    {
        return tl::make_unexpected(port.error());
    }
    _options.port = *port;
    return {};
}

void McsPort::Impl::Stop()
{
    _listener->Stop();
    for (const auto& [connection, gate] : std::exchange(_gates, {}))
    {
        gate->Kill();
    }
}

void McsPort::Impl::Add(const std::shared_ptr<IPortUser>& user)
{
    _users.push_back(user);
}

void McsPort::Impl::Remove(const IPortUser& user)
{
    std::erase_if(_users, [&user](const std::weak_ptr<IPortUser>& other) {
        const std::shared_ptr<IPortUser> locked = other.lock();
        return locked == nullptr || locked.get() == &user;
    });
}

std::uint16_t McsPort::Impl::GetPort() const noexcept
{
    return _options.port;
}

const boost::asio::any_io_executor& McsPort::Impl::GetExecutor() const noexcept
{
    return _executor;
}

void McsPort::Impl::OnAccepted(Tcp::socket socket)
{
    if (_gates.size() + CountLinks() >= _options.maximumClients)
    {
        _logger.Warning("refused a connection: too many clients", {});
        return;
    }
    const Protocol::ConnectionID connection = ++_lastID;
    boost::system::error_code unknown;
    const Tcp::endpoint peer = socket.remote_endpoint(unknown);
    GateOwner owner = MakeGateOwner(connection, unknown ? std::nullopt : std::optional(peer));
    const std::shared_ptr<IGate> gate = _transport->MakeGate(std::move(socket), _options.link, std::move(owner));
    _gates.emplace(connection, gate);
    gate->RunAsync();
}

GateOwner McsPort::Impl::MakeGateOwner(
    Protocol::ConnectionID connection,
    const std::optional<Tcp::endpoint>& peerOrNull)
{
    const std::weak_ptr<Impl> weak = weak_from_this();
    GateOwner owner;
    owner.decide = [weak, connection, peerOrNull](UpgradeRequest request, bool bWebSocket) -> GateDecision {
        const auto self = weak.lock();
        if (self == nullptr)
        {
            return UpgradeRefusal{HTTP_UNAVAILABLE, {}, {}};
        }
        request.connection = connection;
        if (peerOrNull.has_value())
        {
            request.peerAddress = GetText(peerOrNull->address());
            request.peerPort = peerOrNull->port();
        }
        return self->Decide(request, bWebSocket);
    };
    const std::string peer = peerOrNull.has_value() ? GetText(peerOrNull->address()) : std::string();
    owner.onRefused = [weak, peer](const std::string& reason) {
        if (const auto self = weak.lock())
        {
            self->_logger.Warning("a connection did not become a WebSocket", {{"peer", peer}, {"reason", reason}});
        }
    };
    owner.onEnded = [weak, connection] {
        if (const auto self = weak.lock())
        {
            self->_gates.erase(connection);
        }
    };
    return owner;
}

GateDecision McsPort::Impl::Decide(const UpgradeRequest& request, bool bWebSocket)
{
    UpgradeRefusal refusal{HTTP_NOT_FOUND, DescribePath(), {}};
    for (const std::weak_ptr<IPortUser>& weak : _users)
    {
        const std::shared_ptr<IPortUser> user = weak.lock();
        if (user == nullptr)
        {
            continue;
        }
        const std::string& path = user->GetPath();
        if (!path.empty() && StripTarget(request.target) != StripTarget(path))
        {
            continue;
        }
        if (!bWebSocket)
        {
            return UpgradeRefusal{
                HTTP_UPGRADE_REQUIRED,
                "This is the MCS end of MCS-ACS: connect with a WebSocket.\n",
                {}};
        }
        std::optional<UpgradeRefusal> found = user->JudgeOrNull(request);
        if (found.has_value())
        {
            refusal = std::move(*found);
            continue;
        }
        return GateAcceptance{
            user->MakeLinkOwner(request.connection),
            [self = shared_from_this(), user, connection = request.connection](std::shared_ptr<ILink> link) {
                self->_gates.erase(connection);
                user->OnAccepted(connection, std::move(link));
            }};
    }
    return refusal;
}

std::string McsPort::Impl::DescribePath() const
{
    const std::shared_ptr<IPortUser> user = _users.size() == 1 ? _users.front().lock() : nullptr;
    return user == nullptr ? "No ACS connects at this path.\n" : "The ACS connects at " + user->GetPath() + ".\n";
}

std::size_t McsPort::Impl::CountLinks() const
{
    std::size_t count = 0;
    for (const std::weak_ptr<IPortUser>& weak : _users)
    {
        const std::shared_ptr<IPortUser> user = weak.lock();
        count += user == nullptr ? 0 : user->CountLinks();
    }
    return count;
}

McsPort::McsPort(std::shared_ptr<Impl> impl)
    : _impl(std::move(impl))
{
}

McsPort::~McsPort()
{
    _impl->Stop();
}

Core::Result<std::unique_ptr<McsPort>> McsPort::Create(
    const boost::asio::any_io_executor& executor,
    const Core::Logger& logger,
    const PortOptions& options)
{
    Core::Result<std::unique_ptr<ITransport>> transport =
        options.tls.has_value() ? MakeTlsServerTransport(*options.tls) : MakePlainTransport();
    if (!transport.has_value())
    {
        return tl::unexpected<Core::Error>(std::move(transport.error()));
    }
    auto impl = std::make_shared<Impl>(executor, logger, options, std::move(*transport));
    Core::Result<void> listened = impl->Listen();
    if (!listened.has_value())
    {
        return tl::unexpected<Core::Error>(std::move(listened.error()));
    }
    return std::unique_ptr<McsPort>(new McsPort(std::move(impl))); // the constructor is private
}

std::uint16_t McsPort::GetPort() const
{
    return _impl->GetPort();
}

} // namespace ACS::ProtocolBeast
