#include "RawPeer.hpp"
#include "SessionRecorder.hpp"
#include "WebSocketFixture.hpp"
#include <acs/protocol/McsSession.hpp>
#include <acs/protocol_beast/HttpHeaders.hpp>
#include <acs/protocol_beast/McsPort.hpp>
#include <acs/protocol_beast/UpgradeRefusal.hpp>
#include <acs/protocol_beast/UpgradeRequest.hpp>

#include <cstddef>
#include <deque>
#include <memory>
#include <optional>
#include <string>
#include <utility>

// Several ACSs at one port of an MCS: McsPort.

using namespace ACS; // NOLINT(google-build-using-namespace)
using Protocol::LinkLost;
using Protocol::Registered;
using Protocol::RequestReceived;
using Testing::SessionRecorder;

namespace
{

/// One ACS and the server of the MCS for it.
struct Pair
{
    SessionRecorder mcsEvents;
    SessionRecorder acsEvents;
    std::unique_ptr<ProtocolBeast::McsServer> server;
    std::unique_ptr<ProtocolBeast::AcsClient> client;
};

class SharedPortFixture : public Testing::WebSocketFixture
{
public:
    ProtocolBeast::PortOptions portOptions;
    std::unique_ptr<ProtocolBeast::McsPort> port;
    std::deque<Pair> pairs;

    void Open()
    {
        auto created = ProtocolBeast::McsPort::Create(io.get_executor(), logger, portOptions);
        REQUIRE(created.has_value());
        port = std::move(*created);
        serverOptions.port = port->GetPort();
    }

    /// With serverOptions.
    Pair& AddServer()
    {
        Pair& pair = pairs.emplace_back();
        pair.server = ProtocolBeast::McsServer::Create(
            *port,
            clock,
            logger,
            serverOptions,
            std::make_unique<Protocol::McsSession>(serverOptions.session, random),
            pair.mcsEvents);
        return pair;
    }

    void AddServerAt(const std::string& path)
    {
        serverOptions.path = path;
        AddServer();
    }

    void AddServerFor(const std::string& name)
    {
        serverOptions.checkUpgrade =
            [name](const ProtocolBeast::UpgradeRequest& request) -> std::optional<ProtocolBeast::UpgradeRefusal> {
            const std::string* const valueOrNull = ProtocolBeast::FindHeaderOrNull(request.headers, "X-ACS");
            return valueOrNull != nullptr && *valueOrNull == name
                ? std::nullopt
                : std::optional(ProtocolBeast::UpgradeRefusal{401, "not " + name, {}});
        };
        AddServer();
    }

    void ConnectPair(std::size_t index, const std::string& path)
    {
        clientOptions.url = GetURL(path);
        pairs[index].client = MakeClient(pairs[index].acsEvents);
        pairs[index].client->Start();
    }

    /// Whether the ACS is registered and its report reaches its own server.
    [[nodiscard]] bool WasServed(std::size_t index, std::size_t times = 1)
    {
        Pair& pair = pairs[index];
        if (!WasReached([&pair] { return pair.acsEvents.GetAll<Registered>().size() == 1; }))
        {
            return false;
        }
        if (times == 1)
        {
            pair.client->ReplayDone();
        }
        const Protocol::AcsRequest report =
            Testing::MakeReport("r-" + std::to_string(index) + "-" + std::to_string(times));
        return pair.client->TrySendDurable(report) && WasReached([&pair, &report, times] {
                   const auto received = pair.mcsEvents.GetAll<RequestReceived>();
                   return received.size() == times && received.back().request == report;
               });
    }
};

} // namespace

TEST_CASE("Two ACSs at one port by path: each has its own session, and the end of one does not affect the other")
{
    SharedPortFixture rig;
    rig.Open();
    rig.AddServerAt("/line-1/");
    rig.AddServerAt("/line-2/");
    CHECK(rig.pairs[0].server->GetPort() == rig.port->GetPort());
    rig.ConnectPair(0, "/line-1");
    rig.ConnectPair(1, "/line-2/?x=1");
    CHECK(rig.WasServed(0));
    CHECK(rig.WasServed(1));
    CHECK(rig.pairs[0].server->IsRegistered());

    rig.pairs[0].client.reset();
    CHECK(rig.WasReached([&rig] { return !rig.pairs[0].mcsEvents.GetAll<LinkLost>().empty(); }));
    rig.pairs[0].server.reset();
    CHECK(rig.WasServed(1, 2));
    CHECK(rig.pairs[1].mcsEvents.GetAll<LinkLost>().empty());

    rig.ConnectTo(rig.GetURL("/line-1/"));
    REQUIRE(rig.WasLost());
    CHECK(
        rig.acsEvents.GetFirstLoss()
        == "the server refused the connection with HTTP 404: \"The ACS connects at /line-2/.\"");
}

TEST_CASE("Two ACSs at one path by header: the first server whose application accepts a client gets it")
{
    SharedPortFixture rig;
    rig.Open();
    rig.AddServerFor("one");
    rig.AddServerFor("two");
    rig.clientOptions.headers = {{"X-ACS", "two"}};
    rig.ConnectPair(1, "/acs/");
    CHECK(rig.WasServed(1));
    rig.clientOptions.headers = {{"X-ACS", "one"}};
    rig.ConnectPair(0, "/acs/");
    CHECK(rig.WasServed(0));
    rig.clientOptions.headers = {{"X-ACS", "three"}};
    rig.Connect();
    REQUIRE(rig.WasLost());
    CHECK(rig.acsEvents.GetFirstLoss() == "the server refused the connection with HTTP 401: \"not two\"");
    CHECK(rig.pairs[0].acsEvents.GetAll<LinkLost>().empty());
}

TEST_CASE("The limit of connections is that of the whole port")
{
    SharedPortFixture rig;
    rig.portOptions.maximumClients = 1;
    rig.Open();
    rig.AddServerAt("/line-1/");
    rig.AddServerAt("/line-2/");
    rig.ConnectPair(0, "/line-1/");
    REQUIRE(rig.WasServed(0));
    rig.ConnectPair(1, "/line-2/");
    CHECK(rig.WasReached([&rig] { return !rig.pairs[1].acsEvents.GetAll<LinkLost>().empty(); }));
    CHECK(rig.pairs[1].acsEvents.GetAll<Registered>().empty());
}

TEST_CASE("Connections outlive their port, which accepts no other ones")
{
    SharedPortFixture rig;
    rig.Open();
    rig.AddServerAt("/line-1/");
    rig.ConnectPair(0, "/line-1/");
    REQUIRE(rig.WasServed(0));
    rig.port.reset();
    CHECK(rig.WasServed(0, 2));
    rig.Connect("/line-1/");
    CHECK(rig.WasLost());
    rig.pairs[0].server->Stop();
    CHECK(rig.WasReached([&rig] { return !rig.pairs[0].acsEvents.GetAll<LinkLost>().empty(); }));
}

TEST_CASE("A port that cannot be opened is reported with its address")
{
    SharedPortFixture rig;
    rig.Open();
    rig.portOptions.port = rig.port->GetPort();
    const auto second = ProtocolBeast::McsPort::Create(rig.io.get_executor(), rig.logger, rig.portOptions);
    REQUIRE_FALSE(second.has_value());
    CHECK(Core::Describe(second.error()).find("127.0.0.1:" + std::to_string(rig.port->GetPort())) != std::string::npos);
}
