#include "Catch.hpp"
#include "ManualClock.hpp"
#include "SeededRandom.hpp"
#include <acs/core/ECoreError.hpp>
#include <acs/protocol/AcsSession.hpp>
#include <acs/protocol/DurableOutbox.hpp>
#include <acs/protocol/McsSession.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace)
using Protocol::DurableOutbox;
using Protocol::DurableRequest;

namespace
{

class MemoryStore final : public Protocol::IOutboxStore
{
public:
    std::map<std::uint64_t, DurableRequest> requests;
    bool bFailing = false;

    Core::Result<void> Append(const DurableRequest& request) override
    {
        requests.emplace(request.sequence, request);
        return GetResult(); // a store may have written what it reports as failed
    }

    Core::Result<void> Remove(std::uint64_t sequence) override
    {
        requests.erase(sequence);
        return GetResult();
    }

    [[nodiscard]] std::vector<DurableRequest> GetAll() const
    {
        std::vector<DurableRequest> all;
        std::transform(requests.rbegin(), requests.rend(), std::back_inserter(all), [](const auto& entry) {
            return entry.second;
        });
        return all;
    }

private:
    [[nodiscard]] Core::Result<void> GetResult() const
    {
        return bFailing ? Core::Result<void>(Core::Fail(Core::ECoreError::QueueFull, "", "room", "none"))
                        : Core::Result<void>();
    }
};

/// A session with room for a few requests.
class SessionStub
{
public:
    std::vector<std::string> sent; ///< The planIDs.
    std::size_t room = 100;
    std::size_t replays = 0;

    [[nodiscard]] bool TrySendDurable(const Protocol::AcsRequest& request)
    {
        if (room == 0)
        {
            return false;
        }
        --room;
        sent.push_back(std::get<Protocol::PlanReport>(request.payload).planID);
        return true;
    }

    void ReplayDone()
    {
        ++replays;
    }
};

class OutboxFixture
{
public:
    MemoryStore store;
    Testing::SeededRandom random;
    DurableOutbox outbox{store, random};
    SessionStub session;

    /// Registered, with an empty replay completed.
    void Register()
    {
        On(Protocol::Registered{});
        session.replays = 0;
    }

    void Add(const std::string& planID)
    {
        REQUIRE(outbox.Add(Protocol::PlanReport{planID, Protocol::EPlanStatus::Completed, ""}, {}).has_value());
        outbox.Feed(session);
    }

    void On(const Protocol::SessionEvent& event)
    {
        REQUIRE(outbox.OnEvent(event).has_value());
        outbox.Feed(session);
    }

    void Acknowledge(const std::string& transactionID)
    {
        On(Protocol::Acked{Protocol::EAcsCommand::PlanReport, transactionID, Protocol::EAckResult::Success, ""});
    }

    [[nodiscard]] std::string GetTransactionID(std::size_t index) const
    {
        return outbox.GetRequests().at(index).request.transactionID;
    }
};

} // namespace

TEST_CASE("A report is stored before it is sent, and removed with its Ack")
{
    OutboxFixture fixture;
    fixture.Register();
    fixture.session.room = 0;
    fixture.Add("A");
    CHECK(fixture.session.sent.empty());
    REQUIRE(fixture.store.requests.size() == 1);
    CHECK(fixture.store.requests.at(1) == fixture.outbox.GetRequests().front());
    fixture.session.room = 1;
    fixture.On(Protocol::WindowOpened{});
    CHECK(fixture.session.sent == std::vector<std::string>{"A"});
    const std::string transactionID = fixture.GetTransactionID(0);
    fixture.Acknowledge(transactionID);
    CHECK(fixture.store.requests.empty());
    CHECK(fixture.outbox.GetRequests().empty());
    fixture.Acknowledge(transactionID);
    CHECK(fixture.session.sent.size() == 1);
}

TEST_CASE("A dropped report is not sent any more, whether or not it was sent before, and its Ack is ignored")
{
    OutboxFixture fixture;
    fixture.Register();
    fixture.session.room = 2;
    for (const char* planID : {"A", "B", "C", "D"})
    {
        fixture.Add(planID);
    }
    const std::string sentID = fixture.GetTransactionID(0);
    fixture.outbox.Drop(1);
    fixture.outbox.Drop(3);
    fixture.outbox.Drop(3);
    CHECK(fixture.outbox.GetRequests().size() == 2);
    fixture.Acknowledge(sentID);
    CHECK(fixture.store.requests.size() == 4); // removed by the caller
    fixture.session.room = 5;
    fixture.On(Protocol::WindowOpened{});
    CHECK(fixture.session.sent == std::vector<std::string>{"A", "B", "D"});
}

TEST_CASE("After a reconnect everything without an Ack is sent again in order, then ReplayDone is called once")
{
    OutboxFixture fixture;
    fixture.On(Protocol::Registered{});
    CHECK(fixture.session.replays == 1);
    fixture.Add("A");
    fixture.Add("B");
    fixture.Add("C");
    fixture.Acknowledge(fixture.GetTransactionID(1));
    fixture.On(Protocol::LinkLost{"cut", true});
    fixture.session = {};
    fixture.session.room = 1;
    fixture.On(Protocol::Registered{});
    CHECK(fixture.session.sent == std::vector<std::string>{"A"});
    CHECK(fixture.session.replays == 0);
    fixture.session.room = 5;
    fixture.On(Protocol::WindowOpened{});
    CHECK(fixture.session.sent == std::vector<std::string>{"A", "C"});
    CHECK(fixture.session.replays == 1);
    fixture.Add("D");
    CHECK(fixture.session.sent == std::vector<std::string>{"A", "C", "D"});
    CHECK(fixture.session.replays == 1);
}

TEST_CASE("A report between LinkLost and Registered waits for the replay, which sends each report once and in order")
{
    OutboxFixture fixture;
    fixture.Add("A");
    CHECK(fixture.session.sent.empty());
    fixture.On(Protocol::Registered{});
    fixture.On(Protocol::LinkLost{"cut", true});
    fixture.session = {};
    fixture.Add("B"); // the session may be registered already, its event still on the way
    CHECK(fixture.session.sent.empty());
    fixture.On(Protocol::Registered{});
    CHECK(fixture.session.sent == std::vector<std::string>{"A", "B"});
    CHECK(fixture.session.replays == 1);
}

TEST_CASE("A report between Stopped and Registered waits for the replay")
{
    OutboxFixture fixture;
    fixture.Register();
    fixture.Add("A");
    fixture.On(Protocol::Stopped{});
    fixture.session = {};
    fixture.Add("B");
    CHECK(fixture.session.sent.empty());
    fixture.On(Protocol::Registered{});
    CHECK(fixture.session.sent == std::vector<std::string>{"A", "B"});
}

TEST_CASE("Discarded requests are removed from the store and not sent again; the others are")
{
    OutboxFixture fixture;
    fixture.Register();
    fixture.Add("A");
    fixture.Add("B");
    fixture.session.room = 0;
    fixture.Add("C");
    const auto isNotC = [](const DurableRequest& request) {
        return std::get<Protocol::PlanReport>(request.request.payload).planID != "C";
    };
    CHECK(fixture.outbox.Discard(isNotC).value() == 2);
    CHECK(fixture.store.requests.size() == 1);
    fixture.session.room = 5;
    fixture.On(Protocol::WindowOpened{});
    CHECK(fixture.session.sent == std::vector<std::string>{"A", "B", "C"});
    fixture.session = {};
    fixture.On(Protocol::Registered{});
    CHECK(fixture.session.sent == std::vector<std::string>{"C"});
    fixture.store.bFailing = true;
    CHECK_FALSE(fixture.outbox.Discard([](const DurableRequest& /*request*/) { return true; }).has_value());
    CHECK(fixture.outbox.GetRequests().empty());
}

TEST_CASE("A connection that is lost during its replay does not end the replay of the next one")
{
    OutboxFixture fixture;
    fixture.session.room = 0;
    fixture.Add("A");
    fixture.On(Protocol::Registered{});
    fixture.On(Protocol::LinkLost{"cut", true});
    fixture.session.room = 1;
    fixture.Acknowledge(fixture.GetTransactionID(0));
    CHECK(fixture.session.replays == 0);
    fixture.On(Protocol::Registered{});
    CHECK(fixture.session.replays == 1);
}

TEST_CASE("Restored requests come first, in the order of their sequence, and keep their transactionIDs")
{
    OutboxFixture before;
    before.session.room = 0;
    before.Add("A");
    before.Add("B");
    OutboxFixture fixture;
    fixture.store.requests = before.store.requests;
    fixture.outbox.Restore(fixture.store.GetAll());
    fixture.On(Protocol::Registered{});
    fixture.Add("C");
    CHECK(fixture.session.sent == std::vector<std::string>{"A", "B", "C"});
    CHECK(fixture.GetTransactionID(0) == before.GetTransactionID(0));
    CHECK(fixture.outbox.GetRequests().back().sequence == 3);
    CHECK(fixture.store.requests.size() == 3);
}

TEST_CASE("A report that the store refuses is not sent, and its sequence is not used again")
{
    OutboxFixture fixture;
    fixture.store.bFailing = true;
    CHECK_FALSE(fixture.outbox.Add(Protocol::PlanReport{"A", Protocol::EPlanStatus::Completed, ""}, {}).has_value());
    fixture.outbox.Feed(fixture.session);
    CHECK(fixture.session.sent.empty());
    fixture.store.bFailing = false;
    fixture.Add("B");
    CHECK(fixture.outbox.GetRequests().front().sequence == 2);
}

TEST_CASE("An outbox keeps reports only")
{
    OutboxFixture fixture;
    fixture.Register();
    CHECK_FALSE(fixture.outbox.Add(Protocol::RobotPositionUpdate{}, {}).has_value());
    CHECK(fixture.store.requests.empty());
    fixture.outbox.Queue({1, {"t-1", {}, Protocol::RobotStatusUpdate{}}});
    fixture.Add("A");
    CHECK(fixture.session.sent == std::vector<std::string>{"A"});

    OutboxFixture restored;
    restored.outbox.Restore({{3, {"t-3", {}, Protocol::ExecutionPlan{}}}, fixture.outbox.GetRequests().front()});
    restored.On(Protocol::Registered{});
    CHECK(restored.session.sent == std::vector<std::string>{"A"});
    CHECK(restored.session.replays == 1);
    restored.Add("B");
    CHECK(restored.outbox.GetRequests().back().sequence == 4);
}

TEST_CASE("An error while removing is reported; the request is not sent again")
{
    OutboxFixture fixture;
    fixture.Register();
    fixture.Add("A");
    fixture.store.bFailing = true;
    const Protocol::Acked acked{
        Protocol::EAcsCommand::PlanReport,
        fixture.GetTransactionID(0),
        Protocol::EAckResult::Success,
        ""};
    CHECK_FALSE(fixture.outbox.OnEvent(acked).has_value());
    fixture.On(Protocol::Registered{});
    CHECK(fixture.session.sent.size() == 1);
    CHECK(fixture.session.replays == 1);
}

TEST_CASE("A request that the caller has stored is queued as it is")
{
    OutboxFixture fixture;
    fixture.Register();
    fixture.outbox.Queue({7, {"t-7", {}, Protocol::PlanReport{"A", Protocol::EPlanStatus::Completed, ""}}});
    fixture.Add("B");
    CHECK(fixture.session.sent == std::vector<std::string>{"A", "B"});
    CHECK(fixture.outbox.GetRequests().back().sequence == 8);
    CHECK_FALSE(fixture.store.requests.contains(7));
}

namespace
{

/// An ACS over an outbox, until it is killed.
class AcsFixture
{
    const Testing::ManualClock& _clock;
    Protocol::AcsSession _acs;
    DurableOutbox _outbox;
    Protocol::SessionActions _actions;

public:
    AcsFixture(const Testing::ManualClock& clock, Core::IRandom& random, MemoryStore& store)
        : _clock(clock),
          _acs(MakeOptions(), random),
          _outbox(store, random)
    {
        _outbox.Restore(store.GetAll());
        _acs.Start(_clock.GetNow(), _actions);
    }

    void Add(const std::string& planID)
    {
        REQUIRE(_outbox.Add(Protocol::PlanReport{planID, Protocol::EPlanStatus::Completed, ""}, {}).has_value());
        _outbox.Feed(*this);
    }

    [[nodiscard]] bool TrySendDurable(const Protocol::AcsRequest& request)
    {
        return _acs.TrySendDurable(request, _clock.GetNow(), _actions);
    }

    void ReplayDone()
    {
        _acs.ReplayDone(_clock.GetNow(), _actions);
    }

    void Connect()
    {
        _acs.OnConnected(_clock.GetNow(), _actions);
    }

    void OnText(const std::string& text)
    {
        _acs.OnText(text, _clock.GetNow(), _actions);
    }

    void Disconnect()
    {
        _acs.OnClosed("cut", _clock.GetNow(), _actions);
        static_cast<void>(TakeTexts());
    }

    void Reconnect()
    {
        _acs.OnTimer(Protocol::ESessionTimer::Reconnect, _clock.GetNow(), _actions);
    }

    /// Handles all events; returns the texts for the MCS.
    [[nodiscard]] std::vector<std::string> TakeTexts()
    {
        std::vector<std::string> texts;
        while (!_actions.empty())
        {
            for (const Protocol::SessionAction& action : std::exchange(_actions, {}))
            {
                if (const auto* const sendOrNull = std::get_if<Protocol::SendText>(&action); sendOrNull != nullptr)
                {
                    texts.push_back(sendOrNull->text);
                }
                else if (const auto* const deliverOrNull = std::get_if<Protocol::Deliver>(&action))
                {
                    REQUIRE(_outbox.OnEvent(deliverOrNull->event).has_value());
                    _outbox.Feed(*this);
                }
            }
        }
        return texts;
    }

private:
    static Protocol::SessionOptions MakeOptions()
    {
        Protocol::SessionOptions options;
        options.window = 2;
        return options;
    }
};

/// The planID of a report that the MCS receives for the first time.
std::optional<std::string> GetNewReportOrNull(const Protocol::SessionAction& action)
{
    const auto* const deliverOrNull = std::get_if<Protocol::Deliver>(&action);
    const auto* const receivedOrNull =
        deliverOrNull == nullptr ? nullptr : std::get_if<Protocol::RequestReceived>(&deliverOrNull->event);
    const auto* const reportOrNull = receivedOrNull == nullptr || receivedOrNull->bDuplicate
        ? nullptr
        : std::get_if<Protocol::PlanReport>(&receivedOrNull->request.payload);
    return reportOrNull == nullptr ? std::nullopt : std::optional(reportOrNull->planID);
}

} // namespace

TEST_CASE("6 Every report reaches the MCS once and in order, over lost links and restarts")
{
    const int lostFrom = GENERATE(0, 1, 2, 3, 4); // the exchange of a link from which on Acks are lost
    Testing::ManualClock clock;
    Testing::SeededRandom random;
    MemoryStore store;
    Protocol::McsSession mcs({}, random);
    std::vector<std::string> expected;
    std::vector<std::string> received;
    const auto exchangeTexts = [&](AcsFixture& acs, Protocol::ConnectionID connection, int limit) {
        for (int turn = 0; turn < limit + 1; ++turn)
        {
            Protocol::SessionActions fromMCS;
            for (const std::string& text : acs.TakeTexts())
            {
                mcs.OnText(connection, text, clock.GetNow(), fromMCS);
            }
            for (const Protocol::SessionAction& action : fromMCS)
            {
                if (const std::optional<std::string> planID = GetNewReportOrNull(action); planID.has_value())
                {
                    received.push_back(*planID);
                }
                if (const auto* const sendOrNull = std::get_if<Protocol::SendText>(&action);
                    sendOrNull != nullptr && turn < limit)
                {
                    acs.OnText(sendOrNull->text);
                }
            }
        }
    };
    Protocol::ConnectionID connection = 0;
    for (int start = 0; start < 3; ++start)
    {
        AcsFixture acs(clock, random, store);
        for (int link = 0; link < 3; ++link)
        {
            for (int report = 0; report < 3; ++report)
            {
                expected.push_back(std::to_string(start) + std::to_string(link) + std::to_string(report));
                acs.Add(expected.back());
            }
            Protocol::SessionActions unused;
            mcs.OnConnected(++connection, clock.GetNow(), unused);
            acs.Connect();
            const bool bLast = start == 2 && link == 2;
            exchangeTexts(acs, connection, bLast ? 100 : lostFrom);
            acs.Disconnect();
            mcs.OnClosed(connection, "cut", clock.GetNow(), unused);
            clock.Advance(std::chrono::seconds(20));
            acs.Reconnect();
        }
    }
    CHECK(received == expected);
    CHECK(store.requests.empty());
}
