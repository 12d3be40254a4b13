#pragma once

#include "Catch.hpp"
#include "RecordingLogSink.hpp"
#include "SeededRandom.hpp"
#include "SessionRecorder.hpp"
#include "SteadySystemClock.hpp"
#include <acs/protocol_beast/AcsClient.hpp>
#include <acs/protocol_beast/McsServer.hpp>

#include <boost/asio/io_context.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <utility>

namespace ACS::Testing
{

/// Upper limit of each wait; no test depends on the duration.
inline constexpr std::chrono::seconds PATIENCE{10};

/// A server, a client and the loop that runs them.
class WebSocketFixture
{
public:
    boost::asio::io_context io;
    SteadySystemClock clock;
    SeededRandom random;
    RecordingLogSink sink;
    Core::Logger logger{sink, "test"};
    SessionRecorder mcsEvents;
    SessionRecorder acsEvents;
    ProtocolBeast::ServerOptions serverOptions;
    ProtocolBeast::ClientOptions clientOptions;
    std::unique_ptr<ProtocolBeast::McsServer> server;
    std::unique_ptr<ProtocolBeast::AcsClient> client;

    WebSocketFixture()
    {
        clientOptions.session.reconnect.initial = std::chrono::milliseconds(20);
        clientOptions.session.reconnect.maximum = std::chrono::milliseconds(50);
        clientOptions.session.positionInterval = std::chrono::milliseconds(0);
    }

    [[nodiscard]] auto TryListen()
    {
        return ProtocolBeast::McsServer::Create(io.get_executor(), clock, random, logger, serverOptions, mcsEvents);
    }

    void Listen()
    {
        auto created = TryListen();
        REQUIRE(created.has_value());
        server = std::move(*created);
        serverOptions.port = server->GetPort();
    }

    [[nodiscard]] std::string GetURL(const std::string& path = "/acs/", const std::string& host = "127.0.0.1") const
    {
        return (serverOptions.tls.has_value() ? "wss://" : "ws://") + host + ":" + std::to_string(serverOptions.port)
            + path;
    }

    [[nodiscard]] auto TryMakeClient(SessionRecorder& events)
    {
        return ProtocolBeast::AcsClient::Create(io.get_executor(), clock, random, logger, clientOptions, events);
    }

    [[nodiscard]] std::unique_ptr<ProtocolBeast::AcsClient> MakeClient(SessionRecorder& events)
    {
        auto created = TryMakeClient(events);
        REQUIRE(created.has_value());
        return std::move(*created);
    }

    void ConnectTo(const std::string& url)
    {
        clientOptions.url = url;
        client = MakeClient(acsEvents);
        client->Start();
    }

    void Connect(const std::string& path = "/acs/")
    {
        ConnectTo(GetURL(path));
    }

    /// Closes the first connection of the server.
    void CloseFromServer(std::uint16_t code, const std::string& reason) const
    {
        server->Run([code, &reason](Core::Now /*now*/, Protocol::SessionActions& out) {
            out.emplace_back(Protocol::Close{1, code, reason});
        });
    }

    /// Runs the loop until the condition holds; false at the time limit.
    [[nodiscard]] bool WasReached(const std::function<bool()>& condition)
    {
        const auto deadline = std::chrono::steady_clock::now() + PATIENCE;
        bool bReached = condition();
        while (!bReached && std::chrono::steady_clock::now() < deadline)
        {
            io.restart();
            static_cast<void>(io.run_one_for(std::chrono::milliseconds(100)));
            bReached = condition();
        }
        return bReached;
    }

    [[nodiscard]] bool WasRegistered(std::size_t times = 1)
    {
        return WasReached([this, times] { return acsEvents.GetAll<Protocol::Registered>().size() >= times; });
    }

    [[nodiscard]] bool WasLost(std::size_t times = 1)
    {
        return WasReached([this, times] { return acsEvents.GetAll<Protocol::LinkLost>().size() >= times; });
    }

    void RegisterBoth()
    {
        Listen();
        Connect();
        REQUIRE(WasRegistered());
        client->ReplayDone();
    }
};

[[nodiscard]] inline Protocol::AcsRequest MakeReport(const std::string& transactionID, std::string message = "fine")
{
    return {transactionID, {}, Protocol::PlanReport{"P", Protocol::EPlanStatus::InProgress, std::move(message)}};
}

[[nodiscard]] inline Protocol::ExecutionPlan MakePlan(std::size_t jobCount)
{
    Protocol::ExecutionPlan plan{"P", "L", 10, {{1, "MemoryPickAndPlace", "A01.SET01", {}, {}}}};
    for (std::size_t index = 0; index < jobCount; ++index)
    {
        plan.steps[0].jobs.push_back(
            {"cd3a109a-8f19-4f19-86ea-" + std::to_string(552'200'000'000 + index), "AMR.TP01.MP01", "A01.SET01.MP01"});
    }
    return plan;
}

} // namespace ACS::Testing
