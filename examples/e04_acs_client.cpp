// Lesson 4: an AcsClient and an McsServer talk over a real WebSocket, both in this program, on a port that is free.
//
// The client registers, reconnects and resends by itself. What it asks of its user is an outbox: whatever must reach the
// MCS is kept until it is acknowledged, and is given to the client again after every registration.

#include "ExampleRandom.hpp"
#include <acs/protocol_beast/AcsClient.hpp>
#include <acs/protocol_beast/McsServer.hpp>

#include <boost/asio/io_context.hpp>
#include <fmt/core.h>

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace): an example reads better without the prefix

namespace
{

constexpr std::chrono::seconds PATIENCE{10}; ///< Never needed where all goes well.

/// No library reads a clock: the program brings its own.
class SystemClock final : public Core::IClock
{
public:
    [[nodiscard]] Core::Now GetNow() const override
    {
        return {std::chrono::steady_clock::now(), std::chrono::system_clock::now()};
    }
};

/// The MCS of this lesson: the server acknowledges by itself, so there is nothing to do but look on.
class McsSide final : public ProtocolBeast::ISessionHandler
{
public:
    void OnSessionEvent(const Protocol::SessionEvent& event) override
    {
        if (const auto* receivedOrNull = std::get_if<Protocol::RequestReceived>(&event))
        {
            fmt::print("MCS: got a {}\n", Protocol::GetText(Protocol::GetCommand(receivedOrNull->request)));
        }
    }
};

class AcsSide final : public ProtocolBeast::ISessionHandler
{
    ProtocolBeast::McsServer& _server;

public:
    std::unique_ptr<ProtocolBeast::AcsClient> client;
    std::vector<Protocol::AcsRequest> outbox; ///< A real one is on disk: see IPlanStore in libplan.
    bool bStopped = false;

    explicit AcsSide(ProtocolBeast::McsServer& server)
        : _server(server)
    {
    }

    void OnSessionEvent(const Protocol::SessionEvent& event) override
    {
        if (std::holds_alternative<Protocol::Registered>(event))
        {
            fmt::print("ACS: registered\n");
            Replay();
        }
        else if (const auto* ackedOrNull = std::get_if<Protocol::Acked>(&event))
        {
            OnAcked(*ackedOrNull);
        }
        else if (std::holds_alternative<Protocol::Stopped>(event))
        {
            _server.Stop(); // With the last connection and the port gone, the io_context runs dry and main goes on.
            bStopped = true;
        }
    }

private:
    /// Oldest first, then ReplayDone: only now does the client send its status. One report fits into the window of 16;
    /// a program with more goes on at WindowOpened and calls ReplayDone after the last.
    void Replay()
    {
        for (const Protocol::AcsRequest& request : outbox)
        {
            if (!client->TrySendDurable(request))
            {
                return;
            }
        }
        client->ReplayDone();
    }

    void OnAcked(const Protocol::Acked& acked)
    {
        std::erase_if(outbox, [&acked](const Protocol::AcsRequest& request) {
            return request.transactionID == acked.transactionID;
        });
        fmt::print("ACS: {} is acknowledged, {} left in the outbox\n", acked.transactionID, outbox.size());
        client->Stop(); // Says goodbye (AcsCommStateUpdate) and closes; Stopped is the last event.
    }
};

} // namespace

int main() // NOLINT(bugprone-exception-escape): nothing throws here but a full memory
{
    boost::asio::io_context io; // Everything runs on its one thread, hence no locks anywhere.
    const SystemClock clock;
    ExampleRandom random;
    const Core::Logger logger; // Discards all; give it an ILogSink to see what goes on.
    McsSide mcs;
    const auto server = ProtocolBeast::McsServer::Create(io.get_executor(), clock, random, logger, {}, mcs);
    if (!server.has_value())
    {
        fmt::print("{}\n", Core::Describe(server.error()));
        return 1;
    }

    AcsSide acs(**server);
    acs.outbox.push_back(
        {"report-1", {clock.GetNow().wall, {}}, Protocol::PlanReport{"PLAN-1", Protocol::EPlanStatus::Completed, ""}});
    ProtocolBeast::ClientOptions options;
    options.url = fmt::format("ws://127.0.0.1:{}/acs/", (*server)->GetPort());
    auto client = ProtocolBeast::AcsClient::Create(io.get_executor(), clock, random, logger, options, acs);
    if (!client.has_value()) // The URL makes no sense. Nothing is connected yet.
    {
        fmt::print("{}\n", Core::Describe(client.error()));
        return 1;
    }
    acs.client = std::move(*client);
    acs.client->Start();

    io.run_for(PATIENCE);
    return acs.bStopped && acs.outbox.empty() ? 0 : 1;
}
