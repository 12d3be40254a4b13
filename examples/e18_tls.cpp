// Lesson 18: MCS-ACS over wss, with a certificate on both sides. The MCS accepts only clients whose certificate its CA has
// issued, and the ACS only a server whose certificate its CA has issued for the host of the URL.
//
//     e18_tls mcs CA CERTIFICATE KEY                                   (prints its port; Ctrl-C ends it)
//     e18_tls acs wss://localhost:PORT/acs/ CA CERTIFICATE KEY         (registers once and ends)
//
// All files are PEM. Create reads them and reports what is wrong with them. What is wrong with the other side's certificate
// follows with the connection: at the ACS as LinkLost, at the MCS in the log, because a rejected client has no session. The
// lesson is longer than 150 lines because it has both sides.

#include "ExampleClock.hpp"
#include "ExampleRandom.hpp"
#include <acs/protocol_beast/AcsClient.hpp>
#include <acs/protocol_beast/McsServer.hpp>

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/system/error_code.hpp>
#include <fmt/core.h>

#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

using namespace ACS;                // NOLINT(google-build-using-namespace): an example reads better without the prefix
using namespace ACS::ProtocolBeast; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;

namespace
{

class PrintedLog final : public Core::ILogSink
{
public:
    [[nodiscard]] bool ShouldWrite(Core::ELogLevel level) const override
    {
        return level >= Core::ELogLevel::Warning;
    }

    void Write(
        Core::ELogLevel /*level*/,
        std::string_view component,
        std::string_view message,
        std::initializer_list<Core::LogField> fields) override
    {
        fmt::print("{}: {}", component, message);
        for (const Core::LogField& field : fields)
        {
            fmt::print(" {}=\"{}\"", field.key, field.value);
        }
        fmt::print("\n");
    }
};

/// What happens to the one connection of the lesson.
class Side final : public ISessionHandler
{
    std::string _name;

public:
    std::unique_ptr<AcsClient> clientOrNull; ///< Of the ACS.
    bool bRegistered = false;

    explicit Side(std::string name)
        : _name(std::move(name))
    {
    }

    void OnSessionEvent(const Protocol::SessionEvent& event) override
    {
        const auto* const lostOrNull = std::get_if<Protocol::LinkLost>(&event);
        if (std::holds_alternative<Protocol::Registered>(event))
        {
            bRegistered = true;
            fmt::print("{}: registered\n", _name);
        }
        else if (lostOrNull != nullptr && !lostOrNull->bWasRegistered)
        {
            fmt::print("{}: not connected: {}\n", _name, lostOrNull->reason);
        }
        else
        {
            return;
        }
        if (clientOrNull != nullptr)
        {
            clientOrNull->Stop(); // A real ACS continues to try: the certificate may be replaced.
        }
    }
};

int RunMCS(boost::asio::io_context& io, const TlsOptions& tls)
{
    const ExampleClock clock;
    ExampleRandom random;
    PrintedLog log;
    Side mcs("mcs");
    ServerOptions options;
    options.tls = tls;
    const auto server = McsServer::Create(io.get_executor(), clock, random, Core::Logger(log, "mcs"), options, mcs);
    if (!server.has_value())
    {
        fmt::print("{}\n", Core::Describe(server.error()));
        return 2;
    }
    fmt::print("ready: wss=localhost:{}\n", (*server)->GetPort());
    boost::asio::signal_set signals(io, SIGINT, SIGTERM);
    signals.async_wait([&server](const boost::system::error_code& error, int /*number*/) {
        if (!error)
        {
            (*server)->Stop(); // With the last connection the io_context runs out of work.
        }
    });
    io.run();
    return 0;
}

int RunACS(boost::asio::io_context& io, const std::string& url, const TlsOptions& tls)
{
    const ExampleClock clock;
    ExampleRandom random;
    Side acs("acs");
    ClientOptions options;
    options.url = url;
    options.tls = tls;
    auto client = AcsClient::Create(io.get_executor(), clock, random, Core::Logger(), options, acs);
    if (!client.has_value())
    {
        fmt::print("{}\n", Core::Describe(client.error()));
        return 2;
    }
    acs.clientOrNull = std::move(*client);
    acs.clientOrNull->Start();
    io.run_for(10s); // Never needed where all goes well.
    return acs.bRegistered ? 0 : 1;
}

} // namespace

int main(int argc, char** argv) // NOLINT(bugprone-exception-escape): nothing throws here but a full memory
{
    const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
    std::setvbuf(stdout, nullptr, _IOLBF, 0); // Each line at once, also into a pipe.
    boost::asio::io_context io;
    if (argc == 5 && std::string_view(arguments[1]) == "mcs")
    {
        return RunMCS(io, {arguments[2], arguments[3], arguments[4], {}});
    }
    if (argc == 6 && std::string_view(arguments[1]) == "acs")
    {
        return RunACS(io, arguments[2], {arguments[3], arguments[4], arguments[5], {}});
    }
    fmt::print("Usage: e18_tls mcs CA CERTIFICATE KEY | e18_tls acs URL CA CERTIFICATE KEY\n");
    return 2;
}
