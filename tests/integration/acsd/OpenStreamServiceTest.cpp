#include "drivers/OpenStreamService.hpp"

#include "Catch.hpp"
#include "LinePeer.hpp"
#include "ManualClock.hpp"
#include "RecordingLogSink.hpp"
#include "SeededRandom.hpp"
#include "TemporaryFolder.hpp"

#include <boost/asio/io_context.hpp>

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace ACS::Acsd::Test
{

namespace
{

/// A client of the service, and its peer, which is no controller.
struct OpenStreamServiceFixture
{
    boost::asio::io_context context;
    Testing::TemporaryFolder folder;
    Testing::ManualClock clock;
    Testing::SeededRandom random{1};
    Testing::RecordingLogSink log;
    std::unique_ptr<MessageTrace> trace =
        std::move(*MessageTrace::Create(folder.GetPath().string(), {}, clock, Core::Logger(log, "trace")));
    LinePeer peer{context, 0};
    std::size_t sentBytes = 0; ///< As the function of the options received it.
    std::size_t losses = 0;

    [[nodiscard]] std::unique_ptr<OpenStreamAsio::OpenStreamClient> MakeClient(MessageTrace* traceOrNull)
    {
        OpenStreamService service{
            {context.get_executor(), clock, random, Core::Logger(log, "acsd"), traceOrNull},
            "CR01"};
        OpenStreamAsio::OpenStreamClientOptions options;
        options.port = peer.GetPort();
        options.onSent = [this](std::string_view bytes) {
            sentBytes += bytes.size();
        };
        return service.MakeClient(std::move(options), [this](const OpenStream::ClientEvent& event, Core::Now /*now*/) {
            losses += std::holds_alternative<OpenStream::ClientLost>(event) ? 1U : 0U;
        });
    }
};

} // namespace

TEST_CASE("A client of the Open Stream service logs for its robot, and its messages are in the trace")
{
    OpenStreamServiceFixture fixture;
    const auto client = fixture.MakeClient(fixture.trace.get());
    client->Start();
    REQUIRE(fixture.peer.TryRunUntil([&] { return fixture.peer.received.find('\n') != std::string::npos; }));
    fixture.peer.Send("half a line");
    fixture.peer.Close();
    REQUIRE(fixture.peer.TryRunUntil([&] { return fixture.losses > 0; }));
    const std::string text = fixture.trace->GetNewest().GetText(10);
    CHECK_THAT(
        text,
        Catch::Contains(R"("link":"arm","direction":"out","robot":"CR01","text":"{\"cmd\":\"HANDSHAKE\")"));
    CHECK_THAT(text, Catch::Contains(R"("direction":"in","robot":"CR01","text":"half a line")"));
    CHECK(fixture.sentBytes >= fixture.peer.received.size());
    REQUIRE_FALSE(fixture.log.GetLines().empty());
    CHECK(fixture.log.GetLines().front().component == "arm.CR01");
}

TEST_CASE("Without a trace a client of the Open Stream service passes its events and bytes on")
{
    OpenStreamServiceFixture fixture;
    const auto client = fixture.MakeClient(nullptr);
    client->Start();
    REQUIRE(fixture.peer.TryRunUntil([&] { return !fixture.peer.received.empty(); }));
    fixture.peer.Close();
    REQUIRE(fixture.peer.TryRunUntil([&] { return fixture.losses > 0; }));
    CHECK(fixture.sentBytes > 0);
    CHECK(fixture.trace->GetNewest().GetText(10).empty());
}

} // namespace ACS::Acsd::Test
