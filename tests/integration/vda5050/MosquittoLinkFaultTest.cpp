#include "Catch.hpp"
#include "DescriptorDuplicate.hpp"
#include "LinkFixture.hpp"
#include "RawBroker.hpp"

#include <boost/asio/posix/stream_descriptor.hpp>

#include <filesystem>
#include <iterator>
#include <unistd.h>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;

std::ptrdiff_t CountDescriptors()
{
    return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), std::filesystem::directory_iterator{});
}

} // namespace

TEST_CASE("2 A link reconnects to a broker that never answers a subscription or never answers at all")
{
    boost::asio::io_context context;
    RawBroker broker(context);
    auto options = MakeOptions(broker.GetPort(), "waiting");
    options.connectTimeout = 50ms;
    TestLink link(context, options);
    link.link.Subscribe({{"topic", 1}});
    link.link.Start();
    REQUIRE(TryRunUntil(context, [&]() { return broker.connections >= 3; }));
    CHECK(link.listener.ups == 0);
    CHECK(link.log.CountLevel(Core::ELogLevel::Warning) == 1);

    broker.answerSubscribe = [](std::string_view packetID) {
        return "\x90\x03" + std::string(packetID) + "\x01";
    };
    REQUIRE(TryRunUntil(context, [&]() { return link.listener.ups == 1; }));
    CHECK_FALSE(TryRunUntil(
        context,
        [&]() { return link.listener.downs > 0; },
        200ms)); // the time to connect is over and no longer counted
}

TEST_CASE("2 Messages before the answer to the subscriptions are kept up to a limit; dropped ones are reported")
{
    boost::asio::io_context context;
    RawBroker broker(context);
    broker.answerSubscribe = [](std::string_view packetID) {
        std::string answer;
        for (int i = 0; i < 50; ++i)
        {
            answer += RawBroker::MakePublish("topic", std::to_string(i));
        }
        return answer + "\x90\x03" + std::string(packetID) + "\x01";
    };
    auto options = MakeOptions(broker.GetPort(), "flooded");
    options.maxEarly = 20;
    TestLink link(context, options);
    link.link.Subscribe({{"topic", 1}});
    link.link.Start();
    REQUIRE(TryRunUntil(context, [&]() { return link.listener.messages.size() >= 20; }));
    CHECK(link.listener.ups == 1);
    CHECK(link.listener.messages.front().payload == "0");
    CHECK(link.listener.messages.back().payload == "19");
    CHECK(link.log.CountLevel(Core::ELogLevel::Error) == 1);
    const auto& lines = link.log.GetLines();
    CHECK(std::ranges::any_of(lines, [](const RecordedLine& line) { return line.HasField("dropped", "30"); }));
}

TEST_CASE("2 Messages before the answer to the subscriptions are limited in bytes too")
{
    boost::asio::io_context context;
    RawBroker broker(context);
    broker.answerSubscribe = [](std::string_view packetID) {
        std::string answer;
        for (int i = 0; i < 5; ++i)
        {
            answer += RawBroker::MakePublish("topic", std::string(50, 'x'));
        }
        return answer + "\x90\x03" + std::string(packetID) + "\x01";
    };
    auto options = MakeOptions(broker.GetPort(), "flooded");
    options.maxEarlyBytes = 120; // two of them
    TestLink link(context, options);
    link.link.Subscribe({{"topic", 1}});
    link.link.Start();
    REQUIRE(TryRunUntil(context, [&]() { return link.listener.messages.size() >= 2; }));
    const auto& lines = link.log.GetLines();
    CHECK(std::ranges::any_of(lines, [](const RecordedLine& line) { return line.HasField("dropped", "3"); }));
}

TEST_CASE("2 A payload that is longer than allowed is dropped and reported; later messages are delivered")
{
    boost::asio::io_context context;
    RawBroker broker(context);
    broker.answerSubscribe = [](std::string_view packetID) {
        return "\x90\x03" + std::string(packetID) + "\x01";
    };
    auto options = MakeOptions(broker.GetPort(), "brief");
    options.maxPayloadBytes = 20;
    TestLink link(context, options);
    link.link.Subscribe({{"topic", 1}});
    link.link.Start();
    REQUIRE(TryRunUntil(context, [&]() { return link.listener.ups == 1; }));
    broker.Send(RawBroker::MakePublish("topic", std::string(21, 'x')));
    broker.Send(RawBroker::MakePublish("topic", std::string(22, 'x')));
    broker.Send(RawBroker::MakePublish("topic", std::string(20, 'x')));
    REQUIRE(TryRunUntil(context, [&]() { return !link.listener.messages.empty(); }));
    CHECK(link.listener.messages.front().payload.size() == 20);
    CHECK(link.log.CountLevel(Core::ELogLevel::Warning) == 1); // and no more in this connection
    const auto& lines = link.log.GetLines();
    CHECK(std::ranges::any_of(lines, [](const RecordedLine& line) { return line.HasField("bytes", "21"); }));
}

TEST_CASE("2 A QoS 2 message whose PUBCOMP cannot be sent any more is delivered")
{
    boost::asio::io_context context;
    RawBroker broker(context);
    broker.answerSubscribe = [](std::string_view packetID) {
        return "\x90\x03" + std::string(packetID) + "\x02";
    };
    auto options = MakeOptions(broker.GetPort(), "once");
    options.bCleanSession = false;
    TestLink link(context, options);
    link.link.Subscribe({{"topic", 2}});
    link.link.Start();
    REQUIRE(TryRunUntil(context, [&]() { return link.listener.ups == 1; }));
    const std::string packetID("\x00\x07", 2);
    broker.Send(RawBroker::MakePublishOnce("topic", packetID, "kept"));
    const std::string pubrec = "\x50\x02" + packetID;
    REQUIRE(TryRunUntil(context, [&]() { return broker.received.find(pubrec) != std::string::npos; }));
    CHECK(link.listener.messages.empty()); // the broker has not released it
    const std::string pubrel = "\x62\x02" + packetID;
    broker.Send(pubrel);
    broker.Reset();
    REQUIRE(TryRunUntil(context, [&]() { return link.listener.downs == 1; }));
    REQUIRE(link.listener.messages.size() == 1);
    CHECK(link.listener.messages.front().payload == "kept");
}

TEST_CASE("2 A link with a refused subscription does not come up; the filter is logged once and tried again")
{
    boost::asio::io_context context;
    RawBroker broker(context);
    std::string code = "\x80";
    broker.answerSubscribe = [&code](std::string_view packetID) {
        return "\x90\x03" + std::string(packetID) + code;
    };
    TestLink link(context, MakeOptions(broker.GetPort(), "refused"));
    link.link.Subscribe({{"uagv/v2/+/+/state", 1}});
    link.link.Start();
    REQUIRE(TryRunUntil(context, [&]() { return broker.connections >= 3; }));
    CHECK(link.listener.ups == 0);
    CHECK(link.log.CountLevel(Core::ELogLevel::Warning) == 1);
    const auto& lines = link.log.GetLines();
    CHECK(std::ranges::any_of(lines, [](const RecordedLine& line) {
        return line.message.find("uagv/v2/+/+/state") != std::string::npos;
    }));
    // It disconnects properly, so that a vehicle's will is not published at each attempt.
    const std::string disconnect("\xE0\x00", 2);
    CHECK(TryRunUntil(context, [&]() { return broker.received.find(disconnect) != std::string::npos; }));
    code = "\x01";
    REQUIRE(TryRunUntil(context, [&]() { return link.listener.ups == 1; }));

    code = "\x80"; // a later one is only logged
    link.link.Subscribe({{"later", 0}});
    REQUIRE(TryRunUntil(context, [&]() { return link.log.CountLevel(Core::ELogLevel::Error) == 1; }));
    CHECK(std::ranges::any_of(lines, [](const RecordedLine& line) { return line.HasField("filter", "later"); }));
    CHECK(link.link.IsConnected());
}

TEST_CASE("2 A link with an invalid filter does not come up, and the filter is logged")
{
    boost::asio::io_context context;
    RawBroker broker(context);
    TestLink link(context, MakeOptions(broker.GetPort(), "wrong"));
    link.link.Subscribe({{"a/#/b", 0}});
    link.link.Start();
    REQUIRE(TryRunUntil(context, [&]() { return broker.connections >= 2; }));
    CHECK(link.listener.ups == 0);
    CHECK(link.log.CountLevel(Core::ELogLevel::Warning) == 1);
}

TEST_CASE("2 Each StopAsync calls back once, also while another one waits and after the stop")
{
    boost::asio::io_context context;
    RawBroker broker(context);
    broker.answerSubscribe = [](std::string_view packetID) {
        return "\x90\x03" + std::string(packetID) + "\x01";
    };
    TestLink link(context, MakeOptions(broker.GetPort(), "leaving twice"));
    link.link.Subscribe({{"topic", 1}});
    link.link.Start();
    REQUIRE(TryRunUntil(context, [&]() { return link.listener.ups == 1; }));
    std::vector<int> called;
    link.link.StopAsync(std::nullopt, 15s, [&]() { called.push_back(1); });
    link.link.StopAsync(std::nullopt, 15s, [&]() { called.push_back(2); });
    REQUIRE(TryRunUntil(context, [&]() { return called.size() == 2; }));
    link.link.StopAsync(std::nullopt, 15s, [&]() { called.push_back(3); });
    CHECK(called.size() == 2); // never from inside the call
    REQUIRE(TryRunUntil(context, [&]() { return called.size() == 3; }));
    CHECK(called == std::vector{1, 2, 3});
}

TEST_CASE("2 A link that stops disconnects only when the broker has acknowledged all, so that no will is sent")
{
    boost::asio::io_context context;
    RawBroker broker(context);
    broker.answerSubscribe = [](std::string_view packetID) {
        return "\x90\x03" + std::string(packetID) + "\x01";
    };
    TestLink link(context, MakeOptions(broker.GetPort(), "leaving"));
    link.link.Subscribe({{"topic", 1}});
    link.link.Start();
    REQUIRE(TryRunUntil(context, [&]() { return link.listener.ups == 1; }));
    REQUIRE(link.link.Publish({"state", "{}", 1, false}).has_value());
    bool bStopped = false;
    link.link.StopAsync(std::nullopt, 15s, [&]() { bStopped = true; });
    const std::string disconnect("\xE0\x00", 2);
    const auto hasReceived = [&broker](const std::string& bytes) {
        return broker.received.find(bytes) != std::string::npos;
    };
    REQUIRE(TryRunUntil(context, [&]() { return hasReceived("{}"); }));
    CHECK_FALSE(TryRunUntil(
        context,
        [&]() { return hasReceived(disconnect); },
        50ms));
    const std::size_t packetID = broker.received.find("state") + 5;
    broker.Send(std::string("\x40\x02", 2) + broker.received.substr(packetID, 2));
    CHECK(TryRunUntil(context, [&]() { return hasReceived(disconnect) && bStopped; }));
}

TEST_CASE("A descriptor that the executor does not accept is closed")
{
    boost::asio::io_context context;
    boost::asio::posix::stream_descriptor stream(context);
    const std::ptrdiff_t before = CountDescriptors();
    REQUIRE_FALSE(VDA5050::AssignDuplicate(stream, STDOUT_FILENO));
    CHECK(CountDescriptors() == before + 1);
    CHECK(VDA5050::AssignDuplicate(stream, STDOUT_FILENO)); // it has one already
    CHECK(CountDescriptors() == before + 1);
    CHECK(VDA5050::AssignDuplicate(stream, -1) == std::errc::bad_file_descriptor);
}

} // namespace ACS::Testing
