#pragma once

#include "RawMCS.hpp"
#include "RawPeer.hpp"
#include "RawServer.hpp"
#include "WebSocketFixture.hpp"

#include <cstddef>
#include <functional>
#include <memory>
#include <vector>

namespace ACS::Testing
{

/// The client of the SDK against raw MCSs, one for each connection.
class ClientWireFixture : public WebSocketFixture
{
public:
    RawServer raw{io};
    std::vector<std::unique_ptr<RawMCS>> connections;
    std::function<void(std::size_t index, RawMCS& mcs)> onConnection;

    ClientWireFixture()
    {
        raw.onPeer = [this](std::size_t index, RawPeer& peer) {
            connections.push_back(std::make_unique<RawMCS>(peer));
            if (onConnection)
            {
                onConnection(index, *connections.back());
            }
        };
    }

    void RegisterWithRaw()
    {
        ConnectTo(raw.GetURL());
        REQUIRE(WasRegistered());
        client->ReplayDone();
    }
};

} // namespace ACS::Testing
