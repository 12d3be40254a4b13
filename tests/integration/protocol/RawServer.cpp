#include "RawServer.hpp"

#include <boost/asio/ip/address.hpp>
#include <boost/asio/socket_base.hpp>

#include <utility>

namespace ACS::Testing
{

RawServer::RawServer(boost::asio::io_context& io)
    : _acceptor(io, {boost::asio::ip::make_address("127.0.0.1"), 0})
{
    AcceptAsync();
}

RawServer::~RawServer()
{
    boost::system::error_code ignored;
    static_cast<void>(_acceptor.close(ignored));
    for (const std::shared_ptr<RawPeer>& peer : _peers)
    {
        peer->onChange = nullptr;
        peer->Close();
    }
}

void RawServer::SetReceiveBuffer(int bytes)
{
    _acceptor.set_option(boost::asio::socket_base::receive_buffer_size(bytes));
}

std::string RawServer::GetURL(const std::string& scheme, const std::string& host) const
{
    return scheme + "://" + host + ":" + std::to_string(_acceptor.local_endpoint().port()) + "/acs/";
}

std::size_t RawServer::GetCount() const noexcept
{
    return _peers.size();
}

RawPeer& RawServer::GetPeer(std::size_t index) const
{
    return *_peers.at(index);
}

void RawServer::AcceptAsync()
{
    _acceptor.async_accept([this](const boost::system::error_code& error, Tcp::socket socket) {
        if (error)
        {
            return; // closed: this may be gone
        }
        _peers.push_back(std::make_shared<RawPeer>(std::move(socket)));
        if (onPeer)
        {
            onPeer(_peers.size() - 1, *_peers.back());
        }
        AcceptAsync();
    });
}

} // namespace ACS::Testing
