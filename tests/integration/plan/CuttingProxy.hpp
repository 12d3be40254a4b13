#pragma once

#include "MosquittoBroker.hpp"

#include <arpa/inet.h>
#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <netinet/in.h>
#include <poll.h>
#include <string>
#include <string_view>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>

namespace ACS::Planning::Test
{

/// What happens to the connections of a CuttingProxy.
enum class ECut : std::uint8_t
{
    Nothing,
    BeforeCommit, ///< Closed instead of passing on a COMMIT.
    AfterCommit,  ///< Closed instead of passing back that the COMMIT was executed.
    Silence,      ///< Nothing is passed back any more.
};

/// A network between a store and its server that is cut at a chosen moment. One connection at a time.
class CuttingProxy
{
    std::uint16_t _serverPort;
    std::uint16_t _port = 0;
    int _listener = -1;
    int _stop = -1;
    std::atomic<ECut> _cut = ECut::Nothing;
    std::atomic<int> _cuts = 0;
    std::thread _thread;

public:
    explicit CuttingProxy(std::uint16_t serverPort)
        : _serverPort(serverPort),
          _listener(socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0)),
          _stop(eventfd(0, EFD_CLOEXEC))
    {
        sockaddr_in address = MakeAddress(0);
        socklen_t length = sizeof(address);
        auto* const generic = reinterpret_cast<sockaddr*>(&address); // the type of the socket interface
        if (bind(_listener, generic, length) != 0 || listen(_listener, 8) != 0
            || getsockname(_listener, generic, &length) != 0)
        {
            throw std::runtime_error("the proxy cannot listen");
        }
        _port = ntohs(address.sin_port);
        _thread = std::thread([this] { Serve(); });
    }

    CuttingProxy(const CuttingProxy&) = delete;
    CuttingProxy& operator=(const CuttingProxy&) = delete;

    ~CuttingProxy()
    {
        eventfd_write(_stop, 1);
        _thread.join();
        close(_stop);
        close(_listener);
    }

    [[nodiscard]] std::uint16_t GetPort() const noexcept
    {
        return _port;
    }

    /// From the next COMMIT on; a cut happens once.
    void Cut(ECut cut)
    {
        _cut = cut;
    }

    [[nodiscard]] int GetCuts() const noexcept
    {
        return _cuts;
    }

private:
    [[nodiscard]] static sockaddr_in MakeAddress(std::uint16_t port)
    {
        sockaddr_in address{};
        address.sin_family = AF_INET;
        address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
        address.sin_port = htons(port);
        return address;
    }

    void Serve()
    {
        while (IsReady(_listener))
        {
            const int client = accept4(_listener, nullptr, nullptr, SOCK_CLOEXEC);
            const int server = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
            const sockaddr_in address = MakeAddress(_serverPort);
            if (connect(server, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0)
            {
                PassOn(client, server);
            }
            close(server);
            close(client);
        }
    }

    /// False if the proxy ends.
    [[nodiscard]] bool IsReady(int descriptor) const
    {
        std::array<pollfd, 2> waited{{{descriptor, POLLIN, 0}, {_stop, POLLIN, 0}}};
        poll(waited.data(), waited.size(), -1);
        return waited[1].revents == 0;
    }

    void PassOn(int client, int server)
    {
        while (true)
        {
            std::array<pollfd, 3> waited{{{client, POLLIN, 0}, {server, POLLIN, 0}, {_stop, POLLIN, 0}}};
            poll(waited.data(), waited.size(), -1);
            if (waited[2].revents != 0 || (waited[0].revents != 0 && !TryPass(client, server, true))
                || (waited[1].revents != 0 && !TryPass(server, client, false)))
            {
                return;
            }
        }
    }

    /// False if the connection ends, or is cut.
    [[nodiscard]] bool TryPass(int from, int to, bool bRequest)
    {
        std::array<char, 65'536> buffer{};
        const ssize_t count = recv(from, buffer.data(), buffer.size(), 0);
        if (count <= 0)
        {
            return false;
        }
        const std::string_view data(buffer.data(), static_cast<std::size_t>(count));
        const bool bCommit = data.find("COMMIT") != std::string_view::npos;
        if (!bRequest && _cut == ECut::Silence)
        {
            return true;
        }
        if (bCommit && _cut == (bRequest ? ECut::BeforeCommit : ECut::AfterCommit))
        {
            _cut = ECut::Nothing;
            ++_cuts;
            return false;
        }
        return send(to, data.data(), data.size(), MSG_NOSIGNAL) == count;
    }
};

} // namespace ACS::Planning::Test
