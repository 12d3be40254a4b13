#pragma once

#include "RawPeer.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace ACS::Testing
{

/// Accepts on a free port of 127.0.0.1.
class RawServer
{
    using Tcp = boost::asio::ip::tcp;

    Tcp::acceptor _acceptor;
    std::vector<std::shared_ptr<RawPeer>> _peers;

public:
    /// The n-th connection, from 0, has come; the test calls its ReadAsync.
    std::function<void(std::size_t index, RawPeer& peer)> onPeer;

    explicit RawServer(boost::asio::io_context& io);
    RawServer(const RawServer&) = delete;
    RawServer& operator=(const RawServer&) = delete;
    ~RawServer();

    /// Of the sockets accepted from now on: how much the system keeps for a peer that does not read.
    void SetReceiveBuffer(int bytes);

    [[nodiscard]] std::string GetURL(const std::string& scheme = "ws", const std::string& host = "127.0.0.1") const;
    [[nodiscard]] std::size_t GetCount() const noexcept;
    [[nodiscard]] RawPeer& GetPeer(std::size_t index) const;

private:
    void AcceptAsync();
};

} // namespace ACS::Testing
