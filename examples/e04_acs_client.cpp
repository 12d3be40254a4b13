// Lesson 4: an AcsClient and an McsServer talk over a real WebSocket, both in this program, on a port that is free.
//
// The client registers, reconnects and resends by itself. Its user keeps an outbox: a report that must reach the MCS is
// kept until it is acknowledged, and is given to the client again after every registration. DurableOutbox does this
// bookkeeping over any store; here the store keeps nothing, in lesson 9 it is a file.

#include "ExampleRandom.hpp"
#include <acs/protocol/DurableOutbox.hpp>
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

/// The reports are lost with the program.
class NoStore final : public Protocol::IOutboxStore
{
public:
    [[nodiscard]] Core::Result<void> Append(const Protocol::DurableRequest& /*request*/) override
    {
        return {};
    }

    [[nodiscard]] Core::Result<void> Remove(std::uint64_t /*sequence*/) override
    {
        return {};
    }
};

class AcsSide final : public ProtocolBeast::ISessionHandler
{
    ProtocolBeast::McsServer& _server;
    Protocol::DurableOutbox& _outbox;

public:
    std::unique_ptr<ProtocolBeast::AcsClient> client;
    bool bStopped = false;

    AcsSide(ProtocolBeast::McsServer& server, Protocol::DurableOutbox& outbox)
        : _server(server),
          _outbox(outbox)
    {
    }

    void OnSessionEvent(const Protocol::SessionEvent& event) override
    {
        static_cast<void>(_outbox.OnEvent(event)); // An error of the store; this one has none.
        if (std::holds_alternative<Protocol::Registered>(event))
        {
            fmt::print("ACS: registered\n");
        }
        else if (const auto* ackedOrNull = std::get_if<Protocol::Acked>(&event))
        {
            OnAcked(*ackedOrNull);
        }
        else if (std::holds_alternative<Protocol::Stopped>(event))
        {
            _server
                .Stop(); // With the last connection and the port gone, the io_context runs out of work and main continues.
            bStopped = true;
        }
        _outbox.Feed(*client); // In order, as far as the client has room; the client sends its status after the replay.
    }

private:
    void OnAcked(const Protocol::Acked& acked)
    {
        fmt::print(
            "ACS: {} is acknowledged, {} left in the outbox\n",
            acked.transactionID,
            _outbox.GetRequests().size());
        client->Stop(); // Sends AcsCommStateUpdate(false) and closes; Stopped is the last event.
    }
};

} // namespace

int main() // NOLINT(bugprone-exception-escape): nothing throws here but a full memory
{
    boost::asio::io_context io; // Everything runs on its one thread, hence no locks anywhere.
    const SystemClock clock;
    ExampleRandom random;
    const Core::Logger logger; // Discards everything; construct it with an ILogSink to see the log.
    McsSide mcs;
    const auto server = ProtocolBeast::McsServer::Create(io.get_executor(), clock, random, logger, {}, mcs);
    if (!server.has_value())
    {
        fmt::print("{}\n", Core::Describe(server.error()));
        return 1;
    }

    NoStore store;
    Protocol::DurableOutbox outbox(store, random);
    // Add assigns a transactionID; Queue accepts a request that has one, so that the lesson can print it.
    const Protocol::PlanReport report{"PLAN-1", Protocol::EPlanStatus::Completed, ""};
    outbox.Queue({1, {"report-1", {clock.GetNow().wall, {}}, report}});
    AcsSide acs(**server, outbox);
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
    return acs.bStopped && outbox.GetRequests().empty() ? 0 : 1;
}
