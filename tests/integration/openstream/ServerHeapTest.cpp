#include "Catch.hpp"
#include "HeapProbe.hpp"
#include "RecordingLogSink.hpp"
#include "SteadySystemClock.hpp"
#include <acs/openstream_asio/OpenStreamServer.hpp>

#include <boost/asio/buffer.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/read.hpp>
#include <boost/asio/write.hpp>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

using namespace ACS::OpenStream; // NOLINT(google-build-using-namespace)
using ACS::Core::JsonText;
using ACS::Testing::HeapProbe;
using Tcp = boost::asio::ip::tcp;

namespace
{

constexpr int WARM_UP = 100;
constexpr int MEASURED = 400;
constexpr std::chrono::seconds LIMIT{30};

/// Counts in its calls the allocations of the whole program between two samples, then ends the run.
class MeasuringService final : public IOpenApiService
{
    boost::asio::io_context& _context;
    int _calls = 0;
    std::uint64_t _before = 0;

public:
    std::uint64_t taken = 0;
    bool bDone = false;

    explicit MeasuringService(boost::asio::io_context& context)
        : _context(context)
    {
    }

    void Call(const ApiRequest& /*request*/, ACS::Core::Now /*now*/, ApiResponse& response) override
    {
        ++_calls;
        if (_calls == WARM_UP)
        {
            _before = HeapProbe::GetBlockCount();
        }
        if (_calls == WARM_UP + MEASURED)
        {
            taken = HeapProbe::GetBlockCount() - _before;
            bDone = true;
            _context.stop();
        }
        std::string text = response.TakeRoom();
        text = R"({"position":[0.949533,90.949655,-1.5,0.25,45.125,3.75]})";
        response.body = JsonText::FromTrusted(std::move(text));
    }

    void StopControl(ACS::Core::Now /*now*/) override
    {
    }
};

} // namespace

TEST_CASE("8 A tick of the MONITOR allocates nothing in the whole server, from the timer to the socket")
{
    boost::asio::io_context context(1);
    ACS::Testing::SteadySystemClock clock;
    ACS::Testing::RecordingLogSink log;
    MeasuringService service(context);
    ACS::OpenStreamAsio::OpenStreamServerOptions options;
    options.port = 0;
    ACS::OpenStreamAsio::OpenStreamServer
        server(context.get_executor(), clock, ACS::Core::Logger(log, "server"), options, service);
    REQUIRE(server.Start().has_value());
    Tcp::socket peer(context);
    peer.connect(Tcp::endpoint(boost::asio::ip::address_v4::loopback(), server.GetPort()));
    constexpr std::string_view COMMANDS =
        "{\"cmd\":\"HANDSHAKE\",\"payload\":{\"major\":1}}\n"
        "{\"cmd\":\"MONITOR\",\"payload\":{\"url\":\"/a\",\"method\":\"GET\",\"period_ms\":2}}\n";
    boost::asio::write(peer, boost::asio::buffer(COMMANDS));
    // A single run, because Asio reuses the memory of its handlers only within one. The socket buffer has room for all
    // lines.
    context.run_for(LIMIT);
    REQUIRE(service.bDone);
    CHECK(service.taken == 0);
    CHECK(server.GetStats().dataLines >= static_cast<std::uint64_t>(WARM_UP + MEASURED) - 2U);
    std::string received(peer.available(), '\0');
    boost::asio::read(peer, boost::asio::buffer(received));
    CHECK(std::ranges::count(received, '\n') > MEASURED);
}
