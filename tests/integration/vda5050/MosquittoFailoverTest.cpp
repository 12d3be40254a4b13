#include "Catch.hpp"
#include "LinkFixture.hpp"
#include "RawBroker.hpp"

#include <cstdint>
#include <set>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using VDA5050::MosquittoOptions;

constexpr const char* LOCAL = "127.0.0.1";

MosquittoOptions MakeFailoverOptions(std::uint16_t port, const std::vector<VDA5050::MosquittoBroker>& furtherBrokers)
{
    MosquittoOptions options = MakeOptions(port, "roamer");
    options.furtherBrokers = furtherBrokers;
    return options;
}

std::vector<std::string> ListWarnings(const RecordingLogSink& log)
{
    std::vector<std::string> warnings;
    for (const RecordedLine& line : log.GetLines())
    {
        if (line.level == Core::ELogLevel::Warning)
        {
            warnings.push_back(line.message);
        }
    }
    return warnings;
}

std::string MakeText(std::uint16_t port)
{
    return std::string(LOCAL) + ":" + std::to_string(port);
}

} // namespace

TEST_CASE("A lost broker leads to the next one, which is kept when the first one is back; the log names both")
{
    boost::asio::io_context context;
    MosquittoBroker first;
    MosquittoBroker second;
    TestLink link(context, MakeFailoverOptions(first.GetPort(), {{LOCAL, second.GetPort()}}));
    link.link.Subscribe({{"topic", 1}});
    link.link.Start();
    REQUIRE(TryRunUntil(context, [&]() { return link.listener.ups == 1; }));
    CHECK(link.link.GetBrokerIndex() == 0);

    first.Kill();
    REQUIRE(TryRunUntil(context, [&]() { return link.listener.ups == 2; }));
    CHECK(link.link.GetBrokerIndex() == 1);
    const std::vector<std::string> warnings = ListWarnings(link.log);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0], Catch::StartsWith("lost the MQTT broker at " + MakeText(first.GetPort())));
    CHECK_THAT(warnings[0], Catch::EndsWith("trying " + MakeText(second.GetPort()) + " next"));
    const auto& lines = link.log.GetLines();
    CHECK(std::ranges::any_of(lines, [&](const RecordedLine& line) {
        return line.message == "connected to the MQTT broker" && line.HasField("broker", MakeText(second.GetPort()));
    }));

    first.Restart();
    REQUIRE(link.link.Publish({"topic", "still here", 1, false}).has_value());
    REQUIRE(TryRunUntil(context, [&]() { return link.listener.Contains("topic", "still here"); }));
    second.Kill();
    REQUIRE(TryRunUntil(context, [&]() { return link.listener.ups == 3; }));
    CHECK(link.link.GetBrokerIndex() == 0);
}

TEST_CASE("Brokers that cannot be used are logged once each with the reason, and the next one is tried")
{
    boost::asio::io_context context;
    MosquittoBroker last;
    MosquittoBroker refusing("allow_anonymous false\n");
    RawBroker silent(context); // it accepts the connection and answers no subscription
    const std::uint16_t closed = FindFreePort();
    MosquittoOptions options = MakeFailoverOptions(
        closed,
        {{"no-such-host.invalid", 1883},
         {LOCAL, refusing.GetPort()},
         {LOCAL, silent.GetPort()},
         {LOCAL, last.GetPort()}});
    options.connectTimeout = 3s;
    last.Kill();
    TestLink link(context, options);
    link.link.Subscribe({{"topic", 1}});
    link.link.Start();
    REQUIRE(TryRunUntil(context, [&]() { return silent.connections == 2; })); // in the second round
    last.Restart();
    REQUIRE(TryRunUntil(
        context,
        [&]() { return link.listener.ups == 1; },
        30s));
    CHECK(link.link.GetBrokerIndex() == 4);
    const std::vector<std::string> warnings = ListWarnings(link.log);
    REQUIRE(warnings.size() == 5);
    CHECK_THAT(warnings[0], Catch::StartsWith("cannot reach the MQTT broker at " + MakeText(closed)));
    CHECK_THAT(warnings[0], Catch::Contains("Connection refused") && Catch::EndsWith("no-such-host.invalid:1883 next"));
    CHECK_THAT(
        warnings[1],
        Catch::Contains("no-such-host.invalid:1883") && Catch::Contains("check the name of its host"));
    CHECK_THAT(
        warnings[2],
        Catch::Contains(MakeText(refusing.GetPort())) && Catch::Contains("check user name, password"));
    CHECK_THAT(warnings[3], Catch::Contains(MakeText(silent.GetPort())) && Catch::Contains("timed out"));
    CHECK_THAT(warnings[4], Catch::Contains(MakeText(last.GetPort())) && Catch::EndsWith(MakeText(closed) + " next"));
}

TEST_CASE("When all brokers are down the link returns to the one that starts first")
{
    boost::asio::io_context context;
    MosquittoBroker first;
    MosquittoBroker second;
    TestLink link(context, MakeFailoverOptions(first.GetPort(), {{LOCAL, second.GetPort()}}));
    link.link.Start();
    REQUIRE(TryRunUntil(context, [&]() { return link.listener.ups == 1; }));
    second.Kill();
    first.Kill();
    const auto countLines = [&]() {
        return link.log.GetLines().size();
    };
    const std::size_t before = countLines();
    REQUIRE(TryRunUntil(context, [&]() { return countLines() >= before + 6; }));
    CHECK(ListWarnings(link.log).size() == 2);
    first.Restart();
    REQUIRE(TryRunUntil(context, [&]() { return link.listener.ups == 2; }));
    CHECK(link.link.GetBrokerIndex() == 0);
    CHECK(link.listener.downs == 1);
}

TEST_CASE("A broker that refuses a subscription is left for the next one")
{
    boost::asio::io_context context;
    RawBroker refusing(context);
    refusing.answerSubscribe = [](std::string_view packetID) {
        return "\x90\x03" + std::string(packetID) + "\x80";
    };
    const MosquittoBroker second;
    TestLink link(context, MakeFailoverOptions(refusing.GetPort(), {{LOCAL, second.GetPort()}}));
    link.link.Subscribe({{"topic", 1}});
    link.link.Start();
    REQUIRE(TryRunUntil(context, [&]() { return link.listener.ups == 1; }));
    CHECK(link.link.GetBrokerIndex() == 1);
    const std::vector<std::string> warnings = ListWarnings(link.log);
    REQUIRE(warnings.size() == 1);
    CHECK_THAT(warnings[0], Catch::Contains("refuses the subscription topic"));
    CHECK_THAT(warnings[0], Catch::EndsWith("trying " + MakeText(second.GetPort()) + " next"));
}

TEST_CASE("A persistent session continues with the next broker")
{
    boost::asio::io_context context;
    MosquittoBroker first;
    const MosquittoBroker second;
    MosquittoOptions options = MakeFailoverOptions(first.GetPort(), {{LOCAL, second.GetPort()}});
    options.bCleanSession = false;
    TestLink link(context, options);
    link.link.Subscribe({{"topic", 2}});
    link.link.Start();
    REQUIRE(TryRunUntil(context, [&]() { return link.listener.ups == 1; }));
    first.Kill();
    REQUIRE(TryRunUntil(context, [&]() { return link.listener.ups == 2; }));
    REQUIRE(link.link.Publish({"topic", "once", 2, false}).has_value());
    REQUIRE(TryRunUntil(context, [&]() { return link.listener.Contains("topic", "once"); }));
    CHECK(link.listener.CountTopic("topic") == 1);
}

TEST_CASE("Quality of service above that of the broker is lowered: of messages, subscriptions and the will")
{
    boost::asio::io_context context;
    const std::uint8_t maxQos = GENERATE(std::uint8_t{0}, std::uint8_t{1}, std::uint8_t{2});
    const MosquittoBroker broker("allow_anonymous true\nmax_qos " + std::to_string(maxQos) + "\n");
    MosquittoOptions options = MakeOptions(broker.GetPort(), "modest");
    options.maxQos = maxQos;
    options.will = VDA5050::MqttWill{{"will", "gone", 2, false}};
    TestLink watcher(context, MakeOptions(broker.GetPort(), "watcher"));
    watcher.link.Subscribe({{"will", 2}});
    watcher.link.Start();
    REQUIRE(TryRunUntil(context, [&]() { return watcher.listener.ups == 1; }));
    {
        TestLink link(context, options);
        link.link.Subscribe({{"topic", 2}});
        link.link.Start();
        REQUIRE(TryRunUntil(context, [&]() { return link.listener.ups == 1; }));
        REQUIRE(link.link.Publish({"topic", "text", 2, false}).has_value());
        REQUIRE(TryRunUntil(context, [&]() { return !link.listener.messages.empty(); }));
        CHECK(link.listener.messages.front() == VDA5050::MqttMessage{"topic", "text", maxQos, false});
        CHECK(link.listener.downs == 0);
    } // without DISCONNECT
    REQUIRE(TryRunUntil(context, [&]() { return !watcher.listener.messages.empty(); }));
    CHECK(watcher.listener.messages.front().qos == maxQos);
}

TEST_CASE("At most four subscriptions wait for the broker at a time")
{
    boost::asio::io_context context;
    RawBroker broker(context);
    TestLink link(context, MakeOptions(broker.GetPort(), "queued"));
    std::vector<VDA5050::MqttSubscription> subscriptions;
    for (int number = 10; number < 30; ++number)
    {
        subscriptions.push_back({"topic" + std::to_string(number), 1});
    }
    link.link.Subscribe(subscriptions);
    link.link.Start();
    const auto countSubscriptions = [&]() {
        std::size_t count = 0;
        for (const VDA5050::MqttSubscription& subscription : subscriptions)
        {
            count += broker.received.find(subscription.topicFilter) != std::string::npos ? 1U : 0U;
        }
        return count;
    };
    const auto answer = [&broker](char packetID) {
        broker.Send(std::string("\x90\x03\0", 3) + packetID + '\x01');
    };
    REQUIRE(TryRunUntil(context, [&]() { return countSubscriptions() >= 4; }));
    CHECK_FALSE(TryRunUntil(
        context,
        [&]() { return countSubscriptions() > 4; },
        100ms));
    for (char packetID = 1; packetID <= 3; ++packetID)
    {
        answer(packetID);
    }
    REQUIRE(TryRunUntil(context, [&]() { return countSubscriptions() >= 7; }));
    CHECK(countSubscriptions() == 7);
    for (char packetID = 4; packetID <= 19; ++packetID)
    {
        answer(packetID);
    }
    REQUIRE(TryRunUntil(context, [&]() { return countSubscriptions() == 20; }));
    CHECK(link.listener.ups == 0);
    answer(20);
    REQUIRE(TryRunUntil(context, [&]() { return link.listener.ups == 1; }));
}

} // namespace ACS::Testing
