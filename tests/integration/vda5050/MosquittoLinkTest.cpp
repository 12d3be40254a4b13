#include "Catch.hpp"
#include "LinkFixture.hpp"

#include <fstream>
#include <memory>
#include <optional>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using VDA5050::EMqttVersion;
using VDA5050::MqttMessage;
using VDA5050::MqttWill;

class LinkTest
{
protected:
    boost::asio::io_context _context;
    /// A broker without a limit of its own, so that it drops nothing for a slow receiver.
    MosquittoBroker _broker{"allow_anonymous true\nmax_queued_messages 0\n"};
    EMqttVersion _version = EMqttVersion::Version311;

    [[nodiscard]] VDA5050::MosquittoOptions MakeVersionOptions(const std::string& clientID) const
    {
        VDA5050::MosquittoOptions options = MakeOptions(_broker.GetPort(), clientID);
        options.version = _version;
        return options;
    }

    [[nodiscard]] std::unique_ptr<TestLink> MakeConnected(const std::string& clientID, const std::string& filter)
    {
        auto made = std::make_unique<TestLink>(_context, MakeVersionOptions(clientID));
        if (!filter.empty())
        {
            made->link.Subscribe({{filter, 2}});
        }
        made->link.Start();
        REQUIRE(TryRunUntil(_context, [&made]() { return made->listener.ups == 1; }));
        return made;
    }
};

} // namespace

TEST_CASE_METHOD(LinkTest, "6.2 A message arrives with its quality of service, its bytes and nothing else")
{
    _version = GENERATE(EMqttVersion::Version311, EMqttVersion::Version5);
    const auto receiver = MakeConnected("receiver", "uagv/v2/ACS/LR01/#");
    const auto sender = MakeConnected("sender", "");
    const std::string bytes("{\"a\":\0\xFF}", 8);
    for (const std::uint8_t qos : {std::uint8_t{0}, std::uint8_t{1}, std::uint8_t{2}})
    {
        const MqttMessage message{"uagv/v2/ACS/LR01/order", bytes, qos, false};
        REQUIRE(sender->link.Publish(message).has_value());
        REQUIRE(TryRunUntil(_context, [&]() { return receiver->listener.messages.size() == qos + 1U; }));
        CHECK(receiver->listener.messages.back() == message);
    }
    REQUIRE(sender->link.Publish({"uagv/v2/ACS/OTHER/order", "x", 0, false}).has_value());
    REQUIRE(sender->link.Publish({"uagv/v2/ACS/LR01/state", "", 0, false}).has_value());
    REQUIRE(TryRunUntil(_context, [&]() { return receiver->listener.messages.size() == 4; }));
    CHECK(receiver->listener.messages.back().payload.empty());
}

TEST_CASE_METHOD(LinkTest, "6.5 A retained message reaches a later subscriber, marked as retained, after OnLinkUp")
{
    _version = GENERATE(EMqttVersion::Version311, EMqttVersion::Version5);
    const auto sender = MakeConnected("sender", "");
    REQUIRE(sender->link.Publish({"uagv/v2/ACS/LR01/connection", "ONLINE", 1, true}).has_value());
    const auto probe = MakeConnected("probe", "uagv/#");
    REQUIRE(TryRunUntil(_context, [&]() { return !probe->listener.messages.empty(); }));

    TestLink late(_context, MakeVersionOptions("late"));
    std::size_t messagesBeforeUp = 99;
    late.listener.whenUp = [&]() {
        messagesBeforeUp = late.listener.messages.size();
    };
    late.link.Subscribe({{"uagv/v2/+/+/state", 1}, {"uagv/v2/+/+/connection", 1}});
    late.link.Start();
    REQUIRE(TryRunUntil(_context, [&]() { return !late.listener.messages.empty(); }));
    CHECK(messagesBeforeUp == 0);
    CHECK(late.listener.messages.front() == MqttMessage{"uagv/v2/ACS/LR01/connection", "ONLINE", 1, true});
}

TEST_CASE_METHOD(LinkTest, "6.14 The broker publishes the will of a link that vanishes, not of one that disconnects")
{
    _version = GENERATE(EMqttVersion::Version311, EMqttVersion::Version5);
    const auto watcher = MakeConnected("watcher", "last/#");
    for (const bool bTakesLeave : {true, false})
    {
        auto options = MakeVersionOptions("vehicle");
        options.will = MqttWill{{"last/words", "CONNECTIONBROKEN", 1, true}};
        auto vehicle = std::make_unique<TestLink>(_context, options);
        vehicle->link.Start();
        REQUIRE(TryRunUntil(_context, [&]() { return vehicle->listener.ups == 1; }));
        if (bTakesLeave)
        {
            bool bStopped = false;
            vehicle->link.StopAsync(MqttMessage{"last/words", "OFFLINE", 1, true}, 5s, [&]() { bStopped = true; });
            CHECK_FALSE(vehicle->link.Publish({"last/words", "late", 0, false}).has_value());
            REQUIRE(TryRunUntil(_context, [&]() { return bStopped; }));
        }
        vehicle.reset();
        REQUIRE(TryRunUntil(_context, [&]() { return watcher->listener.messages.size() == (bTakesLeave ? 1U : 2U); }));
    }
    CHECK(watcher->listener.messages[0].payload == "OFFLINE");
    CHECK(watcher->listener.messages[1].payload == "CONNECTIONBROKEN");
}

TEST_CASE_METHOD(LinkTest, "6.2 After an outage of the broker the link reconnects and subscribes again automatically")
{
    _version = GENERATE(EMqttVersion::Version311, EMqttVersion::Version5);
    const auto link = MakeConnected("survivor", "topic");
    const auto other = MakeConnected("other", "");
    _broker.Kill();
    REQUIRE(TryRunUntil(_context, [&]() { return link->listener.downs == 1 && other->listener.downs == 1; }));
    const VDA5050::MqttMessage message{"topic", "text", 1, false};
    const Core::Result<void> refused = other->link.Publish(message);
    REQUIRE_FALSE(refused.has_value());
    CHECK(refused.error().code == std::errc::not_connected);
    _broker.Restart();
    REQUIRE(TryRunUntil(_context, [&]() { return link->listener.ups == 2 && other->listener.ups == 2; }));
    REQUIRE(other->link.Publish(message).has_value());
    REQUIRE(TryRunUntil(_context, [&]() { return link->listener.messages.size() == 1; }));
    CHECK(link->log.CountLevel(Core::ELogLevel::Warning) == 1);
}

TEST_CASE_METHOD(LinkTest, "A subscription that was ended receives nothing, also after a reconnect")
{
    _version = GENERATE(EMqttVersion::Version311, EMqttVersion::Version5);
    const auto link = MakeConnected("link", "wanted");
    link->link.Subscribe({{"unwanted", 1}});
    link->link.Unsubscribe("unwanted");
    const auto publishBoth = [&](std::size_t expected) {
        REQUIRE(link->link.Publish({"unwanted", "text", 1, false}).has_value());
        REQUIRE(link->link.Publish({"wanted", "text", 1, false}).has_value());
        REQUIRE(TryRunUntil(_context, [&]() { return link->listener.CountTopic("wanted") == expected; }));
        CHECK(link->listener.CountTopic("unwanted") == 0);
    };
    publishBoth(1);
    _broker.Kill();
    REQUIRE(TryRunUntil(_context, [&]() { return link->listener.downs == 1; }));
    _broker.Restart();
    REQUIRE(TryRunUntil(_context, [&]() { return link->listener.ups == 2; }));
    publishBoth(2);
}

TEST_CASE_METHOD(LinkTest, "An unreachable broker is logged once, with the remedy, and connected when it starts")
{
    _broker.Kill();
    TestLink link(_context, MakeOptions(_broker.GetPort(), "early"));
    link.link.Start();
    const auto countAttempts = [&]() {
        return link.log.GetLines().size();
    };
    REQUIRE(TryRunUntil(_context, [&]() { return countAttempts() >= 4; }));
    CHECK(link.log.CountLevel(Core::ELogLevel::Warning) == 1);
    const std::string& sentence = link.log.GetLines().front().message;
    CHECK_THAT(sentence, Catch::Contains("127.0.0.1:" + std::to_string(_broker.GetPort())));
    CHECK_THAT(sentence, Catch::Contains("start it or correct its address"));
    CHECK(link.listener.downs == 0);
    _broker.Restart();
    REQUIRE(TryRunUntil(_context, [&]() { return link.listener.ups == 1; }));
}

TEST_CASE_METHOD(LinkTest, "2 The broker keeps a persistent session and its messages, but not a clean one")
{
    _version = GENERATE(EMqttVersion::Version311, EMqttVersion::Version5);
    const bool bCleanSession = GENERATE(false, true);
    const auto sender = MakeConnected("sender", "");
    auto options = MakeVersionOptions("sleeper");
    options.bCleanSession = bCleanSession;
    const auto connect = [&]() {
        auto link = std::make_unique<TestLink>(_context, options);
        link->link.Subscribe({{"topic", 2}});
        link->link.Start();
        REQUIRE(TryRunUntil(_context, [&]() { return link->listener.ups == 1; }));
        return link;
    };
    auto sleeper = connect();
    bool bStopped = false;
    sleeper->link.StopAsync(std::nullopt, 5s, [&]() { bStopped = true; });
    REQUIRE(TryRunUntil(_context, [&]() { return bStopped; }));
    REQUIRE(sender->link.Publish({"topic", "meanwhile", 2, false}).has_value());
    const auto probe = MakeConnected("probe", "topic");
    REQUIRE(sender->link.Publish({"topic", "before", 2, false}).has_value());
    REQUIRE(TryRunUntil(_context, [&]() { return probe->listener.Contains("topic", "before"); }));
    sleeper = connect();
    REQUIRE(sender->link.Publish({"topic", "now", 2, false}).has_value());
    REQUIRE(TryRunUntil(_context, [&]() { return sleeper->listener.Contains("topic", "now"); }));
    CHECK(sleeper->listener.Contains("topic", "meanwhile") == !bCleanSession);
}

TEST_CASE("A broker that rejects the password is distinguished from one that is unreachable")
{
    boost::asio::io_context context;
    const MosquittoBroker broker("allow_anonymous false\n");
    TestLink link(context, MakeOptions(broker.GetPort(), "stranger"));
    link.link.Start();
    REQUIRE(TryRunUntil(context, [&]() { return !link.log.GetLines().empty(); }));
    CHECK_THAT(link.log.GetLines().front().message, Catch::Contains("check user name"));
}

TEST_CASE_METHOD(LinkTest, "A link that may not send closes its connection, and connects again when it may")
{
    bool bAllowed = true;
    VDA5050::MosquittoOptions options = MakeOptions(_broker.GetPort(), "leader");
    options.maySend = [&bAllowed] {
        return bAllowed;
    };
    TestLink watcher(_context, MakeOptions(_broker.GetPort(), "watcher"));
    watcher.link.Subscribe({{"topic", 1}});
    watcher.link.Start();
    TestLink link(_context, options);
    link.link.Start();
    REQUIRE(TryRunUntil(_context, [&]() { return watcher.listener.ups == 1 && link.listener.ups == 1; }));
    bAllowed = false;
    CHECK_FALSE(link.link.Publish({"topic", "late", 1, false}).has_value());
    REQUIRE(TryRunUntil(_context, [&]() { return link.listener.downs == 1; }));
    bAllowed = true;
    REQUIRE(TryRunUntil(_context, [&]() { return link.listener.ups == 2; }));
    REQUIRE(link.link.Publish({"topic", "in time", 1, false}).has_value());
    REQUIRE(TryRunUntil(_context, [&]() { return watcher.listener.Contains("topic", "in time"); }));
    CHECK_FALSE(watcher.listener.Contains("topic", "late"));
}

TEST_CASE_METHOD(LinkTest, "Stopping a link that has no connection ends at once")
{
    _broker.Kill();
    TestLink link(_context, MakeOptions(_broker.GetPort(), "lonely"));
    link.link.Start();
    REQUIRE(TryRunUntil(_context, [&]() { return !link.log.GetLines().empty(); }));
    bool bStopped = false;
    link.link.StopAsync(MqttMessage{"last", "OFFLINE", 1, true}, 60s, [&]() { bStopped = true; });
    CHECK_FALSE(bStopped);
    REQUIRE(TryRunUntil(
        _context,
        [&]() { return bStopped; },
        5s));
    _context.restart();
    CHECK(_context.run_for(5s) == 0);
    CHECK(_context.stopped()); // nothing is left that would keep a program running
}

TEST_CASE_METHOD(LinkTest, "A link may be destroyed in a callback of its listener")
{
    const auto sender = MakeConnected("sender", "");
    REQUIRE(sender->link.Publish({"first", "", 1, true}).has_value());
    REQUIRE(sender->link.Publish({"second", "", 1, true}).has_value());

    RecordingLogSink log;
    SeededRandom random;
    RecordingListener listener;
    std::unique_ptr<VDA5050::MosquittoLink> link;
    link = std::make_unique<VDA5050::MosquittoLink>(
        _context.get_executor(),
        random,
        Core::Logger(log, "mqtt"),
        MakeOptions(_broker.GetPort(), "short"),
        listener);
    listener.whenUp = [&]() {
        link.reset();
    };
    link->Subscribe({{"#", 0}});
    link->Start();
    REQUIRE(TryRunUntil(_context, [&]() { return link == nullptr; }));
    CHECK_FALSE(TryRunUntil(
        _context,
        [&]() { return !listener.messages.empty(); },
        100ms));
}

TEST_CASE_METHOD(LinkTest, "6.2 A link keeps an idle connection beyond the broker's keep-alive", "[.long]")
{
    auto options = MakeOptions(_broker.GetPort(), "idle");
    options.keepAlive = 5s;
    TestLink link(_context, options);
    link.link.Start();
    CHECK_FALSE(TryRunUntil(
        _context,
        [&]() { return link.listener.downs > 0; },
        20s));
    CHECK(link.link.IsConnected());
}

TEST_CASE_METHOD(LinkTest, "Sent messages of QoS 0 free their room and do not delay the disconnect")
{
    const auto receiver = MakeConnected("receiver", "load");
    VDA5050::MosquittoOptions options = MakeOptions(_broker.GetPort(), "sender");
    options.maxUnsent = 5;
    TestLink sender(_context, options);
    sender.link.Start();
    REQUIRE(TryRunUntil(_context, [&]() { return sender.listener.ups == 1; }));
    for (std::size_t sent = 1; sent <= 20; ++sent)
    {
        REQUIRE(sender.link.Publish({"load", "x", 0, false}).has_value());
        REQUIRE(TryRunUntil(_context, [&]() { return receiver->listener.messages.size() == sent; }));
    }
    bool bStopped = false;
    sender.link.StopAsync(std::nullopt, 60s, [&bStopped]() { bStopped = true; });
    CHECK(TryRunUntil(_context, [&bStopped]() { return bStopped; }));
}

TEST_CASE_METHOD(LinkTest, "Many messages at once arrive complete and in order")
{
    const auto receiver = MakeConnected("receiver", "load");
    const auto sender = MakeConnected("sender", "");
    std::size_t sent = 0;
    std::size_t refused = 0;
    const auto pump = [&]() {
        while (sent < 5000)
        {
            const Core::Result<void> result = sender->link.Publish({"load", std::to_string(sent), 1, false});
            if (!result.has_value())
            {
                CHECK(result.error().code == Core::ECoreError::QueueFull);
                ++refused;
                return;
            }
            ++sent;
        }
    };
    REQUIRE(TryRunUntil(_context, [&]() {
        pump();
        return receiver->listener.messages.size() >= 5000;
    }));
    CHECK(refused > 0);
    for (std::size_t i = 0; i < 5000; ++i)
    {
        REQUIRE(receiver->listener.messages[i].payload == std::to_string(i));
    }
}

} // namespace ACS::Testing
