#include "ActionRecorder.hpp"
#include "Catch.hpp"
#include "Fixture.hpp"
#include "McsSessionFixture.hpp"
#include <acs/protocol/McsSession.hpp>

#include <chrono>
#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using Protocol::EAckResult;
using Protocol::EAcsCommand;
using Protocol::ESessionTimer;
using Protocol::EUnansweredPolicy;
using Testing::MakeRequestText;

namespace
{

/// An MCS whose application answers some commands.
class AskingMCS : public Testing::McsSessionFixture
{
public:
    explicit AskingMCS(const std::vector<EAcsCommand>& commands, Protocol::McsSessionOptions options = {})
        : McsSessionFixture(MakeOptions(commands, options))
    {
    }

    /// A report of the ACS with this transactionID.
    void Report(Protocol::ConnectionID connection, const std::string& transactionID)
    {
        Text(connection, MakeRequestText("PlanReport", R"({"planId":"P","status":"Completed"})", transactionID));
    }

    /// The token of the only request that was delivered.
    [[nodiscard]] Protocol::AnswerToken GetToken() const
    {
        const auto received = recorder.GetEvents<Protocol::RequestReceived>();
        REQUIRE(received.size() == 1);
        return received[0].token;
    }

private:
    static Protocol::McsSessionOptions MakeOptions(
        const std::vector<EAcsCommand>& commands,
        Protocol::McsSessionOptions options)
    {
        for (const EAcsCommand command : commands)
        {
            options.answeredByApplication.set(static_cast<std::size_t>(command));
        }
        return options;
    }
};

} // namespace

TEST_CASE("R1 A report that the application answers is delivered first, and its Ack is the answer")
{
    const EAckResult result = GENERATE(EAckResult::Success, EAckResult::Fail);
    AskingMCS bench({EAcsCommand::PlanReport});
    bench.Register(1);
    bench.Report(1, "a");
    CHECK(bench.recorder.GetAll<Protocol::SendText>().empty());
    const Protocol::RequestReceived received = bench.recorder.GetEvents<Protocol::RequestReceived>().at(0);
    CHECK(received.connection == 1);
    CHECK_FALSE(received.bDuplicate);
    CHECK(bench.session.GetUnansweredCount() == 1);

    bench.clock.Advance(3s);
    REQUIRE(bench.TryAnswer(received.token, result, "The store is ready."));
    const auto acks = bench.recorder.GetAcks();
    REQUIRE(acks.size() == 1);
    CHECK(acks[0].command == EAcsCommand::PlanReport);
    CHECK(acks[0].transactionID == "a");
    CHECK(acks[0].result == result);
    CHECK(acks[0].message == "The store is ready.");
    CHECK(acks[0].timestamp.time == bench.clock.GetNow().wall);
    CHECK(bench.session.GetUnansweredCount() == 0);
    const Protocol::CommandCounters& counters = bench.session.GetStatistics().Of(EAcsCommand::PlanReport);
    CHECK(counters.acknowledged == 1);
    CHECK(counters.refused == (result == EAckResult::Fail ? 1U : 0U));

    CHECK_FALSE(bench.TryAnswer(received.token));
    CHECK_FALSE(bench.TryAnswer(Protocol::NO_ANSWER));
    CHECK_FALSE(bench.TryAnswer(received.token + 1));
    CHECK(bench.recorder.out.empty());
}

TEST_CASE("R1 Commands that the application does not answer get Success at once, positions nothing")
{
    AskingMCS bench({EAcsCommand::PlanReport, EAcsCommand::RobotPositionUpdate});
    bench.Register(1);
    bench.Text(1, MakeRequestText("TscStateUpdate", R"({"state":"Auto"})", "s"));
    CHECK(bench.recorder.GetAcks().at(0).result == EAckResult::Success);
    CHECK(bench.GetToken() == Protocol::NO_ANSWER);
    bench.Text(1, MakeRequestText("RobotPositionUpdate", R"({"robots":[]})"));
    CHECK(bench.recorder.GetAll<Protocol::SendText>().empty());
    CHECK(bench.GetToken() == Protocol::NO_ANSWER);
    CHECK(bench.session.GetUnansweredCount() == 0);
}

TEST_CASE("R1 Requests are answered in any order, each with its own token")
{
    AskingMCS bench({EAcsCommand::PlanReport});
    bench.Register(1);
    bench.Report(1, "a");
    const Protocol::AnswerToken first = bench.GetToken();
    bench.Report(1, "b");
    const Protocol::AnswerToken second = bench.GetToken();
    CHECK(first != second);
    REQUIRE(bench.TryAnswer(second));
    CHECK(bench.recorder.GetAcks().at(0).transactionID == "b");
    CHECK(bench.recorder.GetAll<Protocol::CancelTimer>().empty());
    REQUIRE(bench.TryAnswer(first));
    CHECK(bench.recorder.GetAcks().at(0).transactionID == "a");
    CHECK(bench.recorder.GetAll<Protocol::CancelTimer>().size() == 1);
}

TEST_CASE("6 A repeated report is delivered once, also while it waits, and always gets the same Ack")
{
    AskingMCS bench({EAcsCommand::PlanReport});
    bench.Register(1);
    bench.Report(1, "a");
    const Protocol::AnswerToken token = bench.GetToken();
    bench.Report(1, "a");
    CHECK(bench.recorder.out.empty());
    CHECK(bench.session.GetUnansweredCount() == 1);
    REQUIRE(bench.TryAnswer(token, EAckResult::Fail, "Unknown plan."));
    const std::string answer = bench.recorder.GetAll<Protocol::SendText>().at(0).text;
    bench.clock.Advance(1h);
    bench.Report(1, "a");
    REQUIRE(bench.recorder.GetAll<Protocol::SendText>().size() == 1);
    CHECK(bench.recorder.GetAll<Protocol::SendText>()[0].text == answer);
    CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().empty());
    CHECK(bench.session.GetStatistics().Of(EAcsCommand::PlanReport).duplicates == 2);
}

TEST_CASE("6 A repeated report that the session answers gets the same Ack, and is delivered as a repeated one")
{
    AskingMCS bench({});
    bench.Register(1);
    bench.Report(1, "a");
    const std::string answer = bench.recorder.GetAll<Protocol::SendText>().at(0).text;
    bench.clock.Advance(5s);
    bench.Report(1, "a");
    CHECK(bench.recorder.GetAll<Protocol::SendText>().at(0).text == answer);
    CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().at(0).bDuplicate);
}

TEST_CASE("6 The kept answers are limited in number and in bytes, the oldest are dropped first")
{
    Protocol::McsSessionOptions options;
    const bool bBytes = GENERATE(false, true);
    (bBytes ? options.answerBytes : options.duplicateMemory) = bBytes ? 250 : 2;
    AskingMCS bench({EAcsCommand::PlanReport}, options);
    bench.Register(1);
    for (const std::string transactionID : {"a", "b", "c"})
    {
        bench.Report(1, transactionID);
        REQUIRE(bench.TryAnswer(bench.GetToken(), EAckResult::Success, std::string(100, 'x')));
    }
    for (const std::string transactionID : {"b", "c"})
    {
        bench.Report(1, transactionID);
        CHECK(bench.recorder.GetAcks().size() == 1);
    }
    bench.Report(1, "a");
    CHECK(bench.GetToken() != Protocol::NO_ANSWER);
}

TEST_CASE("6 An answer after the connection was lost is not sent, but given to the repeated report")
{
    AskingMCS bench({EAcsCommand::PlanReport});
    bench.Register(1);
    bench.Report(1, "a");
    const Protocol::AnswerToken token = bench.GetToken();
    bench.session.OnClosed(1, "gone", bench.clock.GetNow(), bench.recorder.out);
    SECTION("answered before the ACS is back")
    {
        REQUIRE(bench.TryAnswer(token));
        CHECK(bench.recorder.GetAll<Protocol::SendText>().empty());
        bench.Register(2);
        bench.Report(2, "a");
        CHECK(bench.recorder.GetAcks().at(0).message == "Stored.");
        CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().empty());
    }
    SECTION("answered after the report was repeated")
    {
        bench.Register(2);
        bench.Report(2, "a");
        CHECK(bench.recorder.out.empty());
        REQUIRE(bench.TryAnswer(token));
        CHECK(bench.recorder.GetAll<Protocol::SendText>().at(0).connection == 2);
    }
    SECTION("answered when the ACS is back, before the report is repeated")
    {
        bench.Register(2);
        REQUIRE(bench.TryAnswer(token));
        CHECK(bench.recorder.GetAll<Protocol::SendText>().empty());
        bench.Report(2, "a");
        CHECK(bench.recorder.GetAcks().size() == 1);
    }
}

TEST_CASE("A report that the application does not answer in time gets Fail, and later answers have no effect")
{
    AskingMCS bench({EAcsCommand::PlanReport});
    bench.Register(1);
    bench.Report(1, "a");
    const Protocol::AnswerToken token = bench.GetToken();
    CHECK(bench.recorder.GetDelayOrNull(ESessionTimer::Answer) == 10s);
    bench.clock.Advance(4s);
    bench.Report(1, "b");
    bench.clock.Advance(6s);
    bench.Expire(ESessionTimer::Answer);
    const auto acks = bench.recorder.GetAcks();
    REQUIRE(acks.size() == 1);
    CHECK(acks[0].transactionID == "a");
    CHECK(acks[0].result == EAckResult::Fail);
    CHECK(acks[0].message == "The MCS has not answered in time.");
    CHECK(
        bench.recorder.GetEvents<Protocol::RequestGivenUp>()
        == std::vector<Protocol::RequestGivenUp>{{EAcsCommand::PlanReport, "a", token}});
    CHECK(bench.recorder.GetDelayOrNull(ESessionTimer::Answer) == 4s);
    CHECK(bench.session.GetUnansweredCount() == 1);
    CHECK_FALSE(bench.TryAnswer(token));
    bench.Report(1, "a");
    CHECK(bench.recorder.GetAcks().at(0).result == EAckResult::Fail);
    CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().empty());
}

TEST_CASE("By option a report that is not answered in time gets no Ack, and is delivered again when it is repeated")
{
    Protocol::McsSessionOptions options;
    options.unansweredPolicy = EUnansweredPolicy::Silence;
    AskingMCS bench({EAcsCommand::PlanReport}, options);
    bench.Register(1);
    bench.Report(1, "a");
    const Protocol::AnswerToken first = bench.GetToken();
    bench.clock.Advance(10s);
    bench.Expire(ESessionTimer::Answer);
    CHECK(bench.recorder.GetAll<Protocol::SendText>().empty());
    CHECK(bench.recorder.GetEvents<Protocol::RequestGivenUp>().size() == 1);
    bench.Report(1, "a");
    const Protocol::RequestReceived again = bench.recorder.GetEvents<Protocol::RequestReceived>().at(0);
    CHECK(again.bDuplicate);
    CHECK_FALSE(bench.TryAnswer(first));
    REQUIRE(bench.TryAnswer(again.token));
    CHECK(bench.recorder.GetAcks().at(0).result == EAckResult::Success);
}

TEST_CASE("Reports beyond the limit of waiting ones are not delivered: they get Fail, or by option no Ack")
{
    const EUnansweredPolicy policy = GENERATE(EUnansweredPolicy::Fail, EUnansweredPolicy::Silence);
    const bool bFail = policy == EUnansweredPolicy::Fail;
    Protocol::McsSessionOptions options;
    options.maximumUnanswered = 2;
    options.unansweredPolicy = policy;
    AskingMCS bench({EAcsCommand::PlanReport}, options);
    bench.Register(1);
    bench.Report(1, "a");
    const Protocol::AnswerToken token = bench.GetToken();
    bench.Report(1, "b");
    bench.Report(1, "c");
    CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().empty());
    CHECK(
        bench.recorder.GetEvents<Protocol::RequestGivenUp>()
        == std::vector<Protocol::RequestGivenUp>{{EAcsCommand::PlanReport, "c", Protocol::NO_ANSWER}});
    REQUIRE(bench.recorder.GetAcks().size() == (bFail ? 1U : 0U));
    if (bFail)
    {
        CHECK(bench.recorder.GetAcks()[0].message == "Too many requests wait for an answer of the MCS.");
    }
    REQUIRE(bench.TryAnswer(token));
    bench.Report(1, "c");
    CHECK(bench.recorder.GetAcks().size() == (bFail ? 1U : 0U)); // Fail is final
    const auto received = bench.recorder.GetEvents<Protocol::RequestReceived>();
    REQUIRE(received.size() == (bFail ? 0U : 1U));
    if (!bFail)
    {
        CHECK_FALSE(received[0].bDuplicate);
    }
}

TEST_CASE("6.2 The application accepts a registration, also later; until then nothing else is accepted")
{
    AskingMCS bench({EAcsCommand::Registration});
    bench.Register(1);
    CHECK(bench.recorder.GetAll<Protocol::SendText>().empty());
    const Protocol::RequestReceived received = bench.recorder.GetEvents<Protocol::RequestReceived>().at(0);
    CHECK(std::holds_alternative<Protocol::Registration>(received.request.payload));
    CHECK(received.connection == 1);
    CHECK_FALSE(bench.session.IsRegistered());
    bench.Report(1, "early");
    CHECK(bench.recorder.GetAcks().at(0).message == "Register first.");

    bench.clock.Advance(9s);
    REQUIRE(bench.TryAnswer(received.token, EAckResult::Success, "Welcome."));
    CHECK(bench.recorder.GetAcks().at(0).transactionID == "r-1");
    CHECK(bench.recorder.GetAcks().at(0).message == "Welcome.");
    CHECK(bench.recorder.GetEvents<Protocol::Registered>().size() == 1);
    CHECK(bench.session.GetRegisteredOrNull() == Protocol::ConnectionID(1));
    bench.clock.Advance(10s);
    bench.Expire(ESessionTimer::Registration); // cancelled: a decision is not a missing Registration
    CHECK(bench.recorder.out.empty());
    bench.Text(1, MakeRequestText("Registration", "{}", "again"));
    CHECK(bench.recorder.GetAcks().at(0).result == EAckResult::Success);
    CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().empty());
}

TEST_CASE("6.2 A registration that the application refuses gets Fail with the reason, and its connection is closed")
{
    AskingMCS bench({EAcsCommand::Registration});
    bench.Register(1);
    const Protocol::AnswerToken token = bench.GetToken();
    SECTION("by its answer")
    {
        REQUIRE(bench.TryAnswer(token, EAckResult::Fail, "This site has no such ACS."));
        CHECK(bench.recorder.GetAcks().at(0).message == "This site has no such ACS.");
    }
    SECTION("by no answer in time, whatever the policy")
    {
        bench.clock.Advance(10s);
        bench.Expire(ESessionTimer::Answer);
        CHECK(bench.recorder.GetEvents<Protocol::RequestGivenUp>().at(0).token == token);
    }
    REQUIRE(bench.recorder.GetAcks().size() == 1);
    CHECK(bench.recorder.GetAcks()[0].transactionID == "r-1");
    CHECK(bench.recorder.GetAcks()[0].result == EAckResult::Fail);
    const auto closes = bench.recorder.GetAll<Protocol::Close>();
    REQUIRE(closes.size() == 1);
    CHECK(closes[0].connection == 1);
    CHECK(closes[0].code == Protocol::CLOSE_POLICY);
    CHECK_FALSE(bench.session.IsRegistered());
    bench.Text(1, MakeRequestText("Registration", "{}", "again"));
    CHECK(bench.recorder.out.empty());
    bench.session.OnClosed(1, "closed", bench.clock.GetNow(), bench.recorder.out);
    CHECK(bench.recorder.out.empty());
}

TEST_CASE("12.3 The registered ACS is replaced only when the application accepts the other one")
{
    AskingMCS bench({EAcsCommand::Registration});
    bench.Register(1);
    REQUIRE(bench.TryAnswer(bench.GetToken()));
    bench.Register(2);
    const Protocol::AnswerToken second = bench.GetToken();
    CHECK(bench.session.GetRegisteredOrNull() == Protocol::ConnectionID(1));
    SECTION("refused")
    {
        REQUIRE(bench.TryAnswer(second, EAckResult::Fail, "One is enough."));
        CHECK(bench.recorder.GetAll<Protocol::Close>().at(0).connection == 2);
        CHECK(bench.session.GetRegisteredOrNull() == Protocol::ConnectionID(1));
        CHECK(bench.recorder.GetEvents<Protocol::LinkLost>().empty());
    }
    SECTION("accepted")
    {
        REQUIRE(bench.TryAnswer(second));
        CHECK(bench.recorder.GetAll<Protocol::Close>().at(0).connection == 1);
        CHECK(bench.recorder.GetEvents<Protocol::LinkLost>().size() == 1);
        CHECK(bench.session.GetRegisteredOrNull() == Protocol::ConnectionID(2));
    }
}

TEST_CASE("12.3 By option the second of two registrations that wait is refused, whatever the application answers")
{
    Protocol::McsSessionOptions options;
    options.bSecondRefused = true;
    AskingMCS bench({EAcsCommand::Registration}, options);
    bench.Register(1);
    const Protocol::AnswerToken first = bench.GetToken();
    bench.Register(2);
    const Protocol::AnswerToken second = bench.GetToken();
    REQUIRE(bench.TryAnswer(first));
    REQUIRE(bench.TryAnswer(second));
    CHECK(bench.recorder.GetAcks().at(0).result == EAckResult::Fail);
    CHECK(bench.recorder.GetAll<Protocol::Close>().at(0).connection == 2);
    CHECK(bench.session.GetRegisteredOrNull() == Protocol::ConnectionID(1));
}

TEST_CASE("6.2 A registration that waits ends with its connection, and is repeated without a second delivery")
{
    AskingMCS bench({EAcsCommand::Registration});
    bench.Register(1);
    const Protocol::AnswerToken token = bench.GetToken();
    SECTION("the connection is closed")
    {
        bench.recorder.Clear();
        bench.session.OnClosed(1, "gone", bench.clock.GetNow(), bench.recorder.out);
        CHECK(bench.recorder.GetAll<Protocol::CancelTimer>().at(0).timer == ESessionTimer::Answer);
        CHECK_FALSE(bench.TryAnswer(token));
        CHECK_FALSE(bench.session.IsRegistered());
    }
    SECTION("the same again")
    {
        bench.Text(1, MakeRequestText("Registration", "{}", "r-1"));
        CHECK(bench.recorder.out.empty());
        REQUIRE(bench.TryAnswer(token));
        CHECK(bench.recorder.GetAcks().size() == 1);
    }
    SECTION("another one: it takes the place of the first, which gets Fail")
    {
        bench.Text(1, MakeRequestText("Registration", "{}", "r-2"));
        REQUIRE(bench.recorder.GetAcks().size() == 1);
        CHECK(bench.recorder.GetAcks()[0].transactionID == "r-1");
        CHECK(bench.recorder.GetAcks()[0].result == EAckResult::Fail);
        CHECK(bench.recorder.GetEvents<Protocol::RequestReceived>().empty());
        REQUIRE(bench.TryAnswer(token));
        CHECK(bench.recorder.GetAcks().at(0).transactionID == "r-2");
        CHECK(bench.session.IsRegistered());
    }
}

TEST_CASE("6.2 Reports that wait do not keep a registration out")
{
    Protocol::McsSessionOptions options;
    options.maximumUnanswered = 1;
    AskingMCS bench({EAcsCommand::Registration, EAcsCommand::PlanReport}, options);
    bench.Register(1);
    REQUIRE(bench.TryAnswer(bench.GetToken()));
    bench.Report(1, "a");
    bench.Register(2);
    REQUIRE(bench.TryAnswer(bench.GetToken()));
    CHECK(bench.session.GetRegisteredOrNull() == Protocol::ConnectionID(2));
}

TEST_CASE("6.21 isConnected counts from its arrival, not from the answer of the application")
{
    AskingMCS bench({EAcsCommand::AcsCommStateUpdate});
    bench.Register(1);
    bench.Text(1, MakeRequestText("AcsCommStateUpdate", R"({"isConnected":false})", "c"));
    CHECK_FALSE(bench.session.IsTakingPlans());
    REQUIRE(bench.TryAnswer(bench.GetToken()));
    CHECK_FALSE(bench.session.IsTakingPlans());
}
