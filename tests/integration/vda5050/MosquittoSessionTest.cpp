#include "Catch.hpp"
#include "CuttingProxy.hpp"
#include "LinkFixture.hpp"
#include "MosquittoClient.hpp"

#include <memory>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using VDA5050::EMqttVersion;

/// Two links with persistent sessions on a real broker; one of them behind a proxy that cuts.
class SessionTest
{
protected:
    boost::asio::io_context _context;
    MosquittoBroker _broker;
    CuttingProxy _proxy{_context, _broker.GetPort()};

    [[nodiscard]] std::unique_ptr<TestLink> MakeConnected(
        std::uint16_t port,
        const std::string& clientID,
        EMqttVersion version)
    {
        VDA5050::MosquittoOptions options = MakeOptions(port, clientID);
        options.version = version;
        options.bCleanSession = false;
        auto made = std::make_unique<TestLink>(_context, options);
        made->link.Subscribe({{"to/" + clientID, 2}});
        made->link.Start();
        REQUIRE(TryRunUntil(_context, [&made]() { return made->listener.ups == 1; }));
        return made;
    }

    [[nodiscard]] static std::vector<std::string> ListPayloads(const TestLink& link)
    {
        std::vector<std::string> payloads;
        for (const VDA5050::MqttMessage& message : link.listener.messages)
        {
            payloads.push_back(message.payload);
        }
        return payloads;
    }
};

const std::vector<std::string> EACH_ONCE{"1", "2", "3", "4"};

} // namespace

TEST_CASE_METHOD(SessionTest, "2 A QoS 2 message is delivered once, wherever the connection is cut")
{
    const EMqttVersion version = GENERATE(EMqttVersion::Version311, EMqttVersion::Version5);
    const EPacket packet = GENERATE(EPacket::Publish, EPacket::Pubrec, EPacket::Pubrel, EPacket::Pubcomp);
    const bool bForwarded = GENERATE(false, true);
    const bool bTwice = GENERATE(false, true);
    CAPTURE(static_cast<int>(version), static_cast<int>(packet), bForwarded, bTwice);
    const auto receiver = MakeConnected(_proxy.GetPort(), "receiver", version);
    const auto sender = MakeConnected(_broker.GetPort(), "sender", version);
    const bool bToBroker = packet == EPacket::Pubrec || packet == EPacket::Pubcomp;
    const auto send = [&](const std::string& payload) {
        REQUIRE(sender->link.Publish({"to/receiver", payload, 2, false}).has_value());
    };
    _proxy.cutOrNull = CuttingProxy::Cut{packet, bToBroker, bForwarded};
    send("1");
    REQUIRE(TryRunUntil(_context, [&]() { return receiver->listener.downs >= 1; }));
    if (bTwice)
    {
        _proxy.cutOrNull = CuttingProxy::Cut{packet, bToBroker, bForwarded};
    }
    send("2");
    REQUIRE(TryRunUntil(_context, [&]() { return receiver->listener.ups >= 2; }));
    send("3");
    REQUIRE(TryRunUntil(_context, [&]() { return receiver->listener.Contains("to/receiver", "2"); }));
    send("4");
    REQUIRE(TryRunUntil(_context, [&]() { return receiver->listener.Contains("to/receiver", "4"); }));
    CHECK(ListPayloads(*receiver) == EACH_ONCE);
    CHECK_FALSE(TryRunUntil(
        _context,
        [&]() { return receiver->listener.messages.size() > EACH_ONCE.size(); },
        50ms));
}

TEST_CASE_METHOD(SessionTest, "2 A QoS 2 message is published once, wherever the connection is cut")
{
    const EMqttVersion version = GENERATE(EMqttVersion::Version311, EMqttVersion::Version5);
    const EPacket packet = GENERATE(EPacket::Publish, EPacket::Pubrec, EPacket::Pubrel, EPacket::Pubcomp);
    const bool bForwarded = GENERATE(false, true);
    CAPTURE(static_cast<int>(version), static_cast<int>(packet), bForwarded);
    const auto receiver = MakeConnected(_broker.GetPort(), "receiver", version);
    const auto sender = MakeConnected(_proxy.GetPort(), "sender", version);
    const bool bToBroker = packet == EPacket::Publish || packet == EPacket::Pubrel;
    _proxy.cutOrNull = CuttingProxy::Cut{packet, bToBroker, bForwarded};
    const auto send = [&](const std::string& payload) {
        REQUIRE(sender->link.Publish({"to/receiver", payload, 2, false}).has_value());
    };
    send("1");
    send("2");
    REQUIRE(TryRunUntil(_context, [&]() { return sender->listener.ups == 2; }));
    send("3");
    send("4");
    REQUIRE(TryRunUntil(_context, [&]() { return receiver->listener.Contains("to/receiver", "4"); }));
    CHECK(ListPayloads(*receiver) == EACH_ONCE);
}

TEST_CASE_METHOD(SessionTest, "2 A link with a second copy of a message starts a new session when nothing is in flight")
{
    const EMqttVersion version = GENERATE(EMqttVersion::Version311, EMqttVersion::Version5);
    const auto receiver = MakeConnected(_proxy.GetPort(), "receiver", version);
    const auto sender = MakeConnected(_broker.GetPort(), "sender", version);
    _proxy.cutOrNull = CuttingProxy::Cut{EPacket::Pubrec, true, false}; // so the broker sends it again
    REQUIRE(sender->link.Publish({"to/receiver", "1", 2, false}).has_value());
    // The renewal may come before the connection after the cut has its subscriptions, so without OnLinkUp.
    const auto& lines = receiver->log.GetLines();
    const auto isRenewed = [&]() {
        const auto renewal =
            std::ranges::find(lines, "starts a new session on the MQTT broker", &RecordedLine::message);
        return std::any_of(renewal, lines.end(), [](const RecordedLine& line) {
            return line.message == "connected to the MQTT broker";
        });
    };
    REQUIRE(TryRunUntil(_context, isRenewed));
    const std::size_t downs = receiver->listener.downs;
    CHECK(receiver->listener.ups == downs + 1);
    CHECK(ListPayloads(*receiver) == std::vector<std::string>{"1"});
    CHECK(std::ranges::count(lines, "starts a new session on the MQTT broker", &RecordedLine::message) == 1);
    CHECK(receiver->log.CountLevel(Core::ELogLevel::Warning) == 1); // the cut
    CHECK_FALSE(TryRunUntil(
        _context,
        [&]() { return receiver->listener.downs > downs; },
        100ms));
}

TEST_CASE_METHOD(
    SessionTest,
    "2 Messages acknowledged before the subscriptions were confirmed are delivered after the next connection")
{
    const EMqttVersion version = GENERATE(EMqttVersion::Version311, EMqttVersion::Version5);
    auto receiver = MakeConnected(_proxy.GetPort(), "receiver", version);
    bool bStopped = false;
    receiver->link.StopAsync(std::nullopt, 5s, [&]() { bStopped = true; });
    REQUIRE(TryRunUntil(_context, [&]() { return bStopped; }));
    const auto probe = MakeConnected(_broker.GetPort(), "probe", version);
    const auto sender = MakeConnected(_broker.GetPort(), "sender", version);
    REQUIRE(sender->link.Publish({"to/receiver", "kept", 1, false}).has_value());
    REQUIRE(sender->link.Publish({"to/probe", "after it", 1, false}).has_value());
    REQUIRE(TryRunUntil(_context, [&]() { return !probe->listener.messages.empty(); }));

    const std::size_t connections = _proxy.connections;
    _proxy.cutOrNull = CuttingProxy::Cut{EPacket::Suback, false, false};
    receiver = MakeConnected(_proxy.GetPort(), "receiver", version);
    CHECK(_proxy.connections == connections + 2);
    REQUIRE(sender->link.Publish({"to/receiver", "new", 1, false}).has_value());
    REQUIRE(TryRunUntil(_context, [&]() { return receiver->listener.Contains("to/receiver", "new"); }));
    CHECK(ListPayloads(*receiver) == std::vector<std::string>{"kept", "new"});
}

TEST_CASE_METHOD(SessionTest, "2 The messages of a session that the broker has lost are not sent again")
{
    const EMqttVersion version = GENERATE(EMqttVersion::Version311, EMqttVersion::Version5);
    const auto receiver = MakeConnected(_broker.GetPort(), "receiver", version);
    const auto sender = MakeConnected(_proxy.GetPort(), "sender", version);
    _proxy.cutOrNull = CuttingProxy::Cut{EPacket::Publish, true, false};
    REQUIRE(sender->link.Publish({"to/receiver", "old", 2, false}).has_value());
    _broker.Kill();
    REQUIRE(TryRunUntil(_context, [&]() { return sender->listener.downs == 1; }));
    _broker.Restart();
    REQUIRE(TryRunUntil(_context, [&]() { return sender->listener.ups == 2 && receiver->listener.ups == 2; }));
    REQUIRE(sender->link.Publish({"to/receiver", "new", 2, false}).has_value());
    REQUIRE(TryRunUntil(_context, [&]() { return receiver->listener.Contains("to/receiver", "new"); }));
    CHECK(ListPayloads(*receiver) == std::vector<std::string>{"new"});
}

TEST_CASE_METHOD(
    SessionTest,
    "2 Two clients with one id log the conflict once, and replace each other without further lines")
{
    const EMqttVersion version = GENERATE(EMqttVersion::Version311, EMqttVersion::Version5);
    const bool bCleanSession = GENERATE(true, false);
    VDA5050::MosquittoOptions options = MakeOptions(_broker.GetPort(), "twin");
    options.version = version;
    options.bCleanSession = bCleanSession;
    TestLink first(_context, options);
    TestLink second(_context, options);
    first.link.Start();
    REQUIRE(TryRunUntil(_context, [&]() { return first.listener.ups == 1; }));
    second.link.Start();
    REQUIRE(TryRunUntil(_context, [&]() { return first.listener.downs >= 6 && second.listener.downs >= 6; }));
    for (const TestLink* const link : {&first, &second})
    {
        CHECK(link->log.CountLevel(Core::ELogLevel::Error) == 1);
        const auto& lines = link->log.GetLines();
        const auto error = std::ranges::find(lines, Core::ELogLevel::Error, &RecordedLine::level);
        REQUIRE(error != lines.end());
        CHECK_THAT(error->message, Catch::Contains("client id twin"));
        CHECK_THAT(error->message, Catch::Contains("give each client an id of its own"));
        CHECK(std::none_of(error, lines.end(), [](const RecordedLine& line) {
            return line.level == Core::ELogLevel::Warning || line.level == Core::ELogLevel::Info;
        }));
    }
}

TEST_CASE("2 Of libmosquitto's log only the line about a received message is evaluated")
{
    using VDA5050::ReadPublishLineOrNull;
    const auto publish =
        ReadPublishLineOrNull("Client a, q9 received PUBLISH (d1, q2, r0, m65535, 't', ... (5 bytes))");
    REQUIRE(publish.has_value());
    CHECK(*publish == VDA5050::ReceivedPublish{65535, 2});
    CHECK_FALSE(ReadPublishLineOrNull("Client a received PUBREL (Mid: 7)").has_value());
    CHECK_FALSE(ReadPublishLineOrNull("Client a sending PUBLISH (d0, q2, r0, m7, 't', ... (5 bytes))").has_value());
    CHECK_FALSE(ReadPublishLineOrNull("Client a received PUBLISH (d0, q2").has_value());
    CHECK_FALSE(ReadPublishLineOrNull("").has_value());
}

} // namespace ACS::Testing
