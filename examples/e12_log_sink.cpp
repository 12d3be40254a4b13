// Lesson 12: a log sink of your own. The libraries log through Core::ILogSink and leave open where the lines go. QueuedLog
// keeps them in a queue with room for 100 lines, and a thread writes them to standard output. If the reader of the log
// stops, the program continues: lines without room are dropped and counted.
//
//     e12_log_sink | less        (the program ends its work although less reads one page only)
//
// The lines come from an OpenStreamServer that logs each of 1000 visitors twice. Any peer can flood a log like this.

#include "QueuedLog.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/openstream/IOpenApiService.hpp>
#include <acs/openstream_asio/OpenStreamServer.hpp>

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/address_v4.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/system/error_code.hpp>
#include <fmt/core.h>

#include <array>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <thread>

using namespace ACS::OpenStreamAsio; // NOLINT(google-build-using-namespace): an example reads better without the prefix
namespace Core = ACS::Core;
using boost::asio::ip::tcp;

namespace
{

class SystemClock final : public Core::IClock
{
public:
    [[nodiscard]] Core::Now GetNow() const override
    {
        return {std::chrono::steady_clock::now(), std::chrono::system_clock::now()};
    }
};

/// No visitor of this lesson calls it.
class SilentService final : public ACS::OpenStream::IOpenApiService
{
public:
    void Call(const ACS::OpenStream::ApiRequest&, Core::Now, ACS::OpenStream::ApiResponse& response) override
    {
        response = {};
    }

    void StopControl(Core::Now /*now*/) override
    {
    }
};

constexpr int VISITORS = 1000;

/// Connects, and closes without a word, again and again. The server logs the beginning and the end of each connection.
void VisitServer(std::uint16_t port)
{
    boost::asio::io_context io;
    for (int i = 0; i < VISITORS; ++i)
    {
        boost::system::error_code ended;
        tcp::socket socket(io);
        socket.connect({boost::asio::ip::address_v4::loopback(), port}, ended);
        socket.shutdown(tcp::socket::shutdown_send, ended);
        std::array<char, 512> answer{};
        while (!ended)
        {
            socket.read_some(boost::asio::buffer(answer), ended);
        }
    }
}

} // namespace

int main() // NOLINT(bugprone-exception-escape): nothing throws here but a full memory
{
    std::signal(SIGPIPE, SIG_IGN); // NOLINT(cert-err33-c): a reader that ends must not end the program
    QueuedLog log;                 // Outlives all loggers.
    boost::asio::io_context io;
    SystemClock clock;
    SilentService service;
    OpenStreamServerOptions options;
    options.port = 0; // One that is free.
    OpenStreamServer server(io.get_executor(), clock, Core::Logger(log, "stream"), options, service);
    if (const Core::Result<void> started = server.Start(); !started.has_value())
    {
        fmt::print(stderr, "{}\n", Core::Describe(started.error()));
        return 1;
    }
    std::thread visitors([&io, &server, port = server.GetPort()]() {
        VisitServer(port);
        boost::asio::post(io, [&server]() { server.Stop(); }); // Now the io_context runs out of work.
    });
    io.run();
    visitors.join();
    fmt::print(stderr, "{} visitors were served\n", VISITORS);
    fmt::print(stderr, "{} lines were dropped\n", log.Close());
    return 0;
}
