#include "ActionRecorder.hpp"
#include "Catch.hpp"
#include "Fixture.hpp"
#include "McsSessionFixture.hpp"
#include <acs/protocol/McsSession.hpp>

#include <chrono>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using Protocol::EAckResult;
using Protocol::EAcsCommand;
using Protocol::ESessionTimer;
using Protocol::EUnansweredReason;
using Testing::MakeAckText;
using Testing::MakeRequestText;

namespace
{

/// An MCS with a registered ACS on connection 1.
class SendingMCS : public Testing::McsSessionFixture
{
public:
    explicit SendingMCS(std::size_t ackRetries = 0)
        : McsSessionFixture(MakeOptions(ackRetries))
    {
        Register(1);
        recorder.Clear();
    }

    [[nodiscard]] Protocol::AcsRequest Make(Protocol::AcsPayload payload)
    {
        return session.MakeRequest(std::move(payload), clock.GetNow());
    }

    [[nodiscard]] bool TrySend(const Protocol::AcsRequest& request)
    {
        recorder.Clear();
        return session.TrySend(request, clock.GetNow(), recorder.out);
    }

    [[nodiscard]] std::vector<Protocol::RequestUnanswered> GetUnanswered() const
    {
        return recorder.GetEvents<Protocol::RequestUnanswered>();
    }

private:
    static Protocol::McsSessionOptions MakeOptions(std::size_t ackRetries)
    {
        Protocol::McsSessionOptions options;
        options.ackRetries = ackRetries;
        return options;
    }
};

} // namespace

TEST_CASE("6.3 A request without an Ack is sent again with the same text, up to the limit, then reported")
{
    const std::size_t retries = GENERATE(0U, 2U);
    SendingMCS mcs(retries);
    const Protocol::AcsRequest request = mcs.Make(Protocol::CancelPlan{"P", "r"});
    REQUIRE(mcs.TrySend(request));
    const std::string text = mcs.recorder.GetAll<Protocol::SendText>().at(0).text;
    for (std::size_t i = 0; i < retries; ++i)
    {
        mcs.clock.Advance(5s);
        mcs.Expire(ESessionTimer::Ack);
        const auto sent = mcs.recorder.GetAll<Protocol::SendText>();
        REQUIRE(sent.size() == 1);
        CHECK(sent[0].text == text);
        CHECK(mcs.recorder.GetDelayOrNull(ESessionTimer::Ack) == 5s);
        CHECK(mcs.GetUnanswered().empty());
    }
    mcs.clock.Advance(5s);
    mcs.Expire(ESessionTimer::Ack);
    CHECK(mcs.recorder.GetAll<Protocol::SendText>().empty());
    CHECK(
        mcs.GetUnanswered()
        == std::vector<Protocol::RequestUnanswered>{
            {EAcsCommand::CancelPlan, request.transactionID, EUnansweredReason::Timeout, retries + 1}});
    CHECK(mcs.session.GetStatistics().Of(EAcsCommand::CancelPlan).sent == retries + 1);
    CHECK(mcs.session.GetPendingCount() == 0);
}

TEST_CASE("6.3 A request that was sent again ends with its first Ack")
{
    SendingMCS mcs(3);
    const Protocol::AcsRequest request = mcs.Make(Protocol::CancelPlan{"P", "r"});
    REQUIRE(mcs.TrySend(request));
    mcs.clock.Advance(5s);
    mcs.Expire(ESessionTimer::Ack);
    mcs.Text(1, MakeAckText("CancelPlan", request.transactionID, "Fail"));
    REQUIRE(mcs.recorder.GetEvents<Protocol::AckReceived>().size() == 1);
    CHECK(mcs.recorder.GetEvents<Protocol::AckReceived>()[0].ack.result == EAckResult::Fail);
    CHECK_FALSE(mcs.recorder.GetEvents<Protocol::AckReceived>()[0].bLate);
    mcs.Text(1, MakeAckText("CancelPlan", request.transactionID, "Fail"));
    CHECK(mcs.recorder.GetEvents<Protocol::AckReceived>().empty());
    mcs.clock.Advance(5s);
    mcs.Expire(ESessionTimer::Ack);
    CHECK(mcs.recorder.GetAll<Protocol::SendText>().empty());
}

TEST_CASE("6.3 A request ends when its connection is lost or another ACS registers, with the reason")
{
    SendingMCS mcs(3);
    const Protocol::AcsRequest request = mcs.Make(Protocol::CancelPlan{"P", "r"});
    REQUIRE(mcs.TrySend(request));
    EUnansweredReason reason = EUnansweredReason::LinkLost;
    SECTION("lost")
    {
        mcs.recorder.Clear();
        mcs.session.OnClosed(1, "gone", mcs.clock.GetNow(), mcs.recorder.out);
    }
    SECTION("replaced")
    {
        mcs.Register(2);
        reason = EUnansweredReason::Replaced;
    }
    CHECK(
        mcs.GetUnanswered()
        == std::vector<Protocol::RequestUnanswered>{{EAcsCommand::CancelPlan, request.transactionID, reason, 1}});
    mcs.clock.Advance(5s);
    mcs.Expire(ESessionTimer::Ack);
    CHECK(mcs.recorder.out.empty());
}

TEST_CASE("6.3 A request that ended without an Ack may be sent again, with the same transactionId")
{
    SendingMCS mcs;
    const Protocol::AcsRequest request = mcs.Make(Protocol::CancelPlan{"P", "r"});
    REQUIRE(mcs.TrySend(request));
    mcs.session.OnClosed(1, "gone", mcs.clock.GetNow(), mcs.recorder.out);
    mcs.Register(2);
    REQUIRE(mcs.TrySend(request));
    CHECK(mcs.recorder.GetRequests().at(0) == request);
    mcs.Text(2, MakeAckText("CancelPlan", request.transactionID));
    REQUIRE(mcs.recorder.GetEvents<Protocol::AckReceived>().size() == 1);
    CHECK_FALSE(mcs.recorder.GetEvents<Protocol::AckReceived>()[0].bLate);
    mcs.Text(2, MakeAckText("CancelPlan", request.transactionID));
    CHECK(mcs.recorder.GetEvents<Protocol::AckReceived>().empty());
    CHECK(mcs.session.GetStatistics().Of(EAcsCommand::CancelPlan).answered == 1);
}

TEST_CASE("6.3 A late Ack is delivered as such")
{
    SendingMCS mcs;
    const Protocol::AcsRequest request = mcs.Make(Protocol::CancelPlan{"P", "r"});
    REQUIRE(mcs.TrySend(request));
    mcs.clock.Advance(5s);
    mcs.Expire(ESessionTimer::Ack);
    mcs.Text(1, MakeAckText("CancelPlan", request.transactionID));
    REQUIRE(mcs.recorder.GetEvents<Protocol::AckReceived>().size() == 1);
    CHECK(mcs.recorder.GetEvents<Protocol::AckReceived>()[0].bLate);
}

TEST_CASE("6.3 A pending request is not sent a second time by the application")
{
    SendingMCS mcs;
    const Protocol::AcsRequest request = mcs.Make(Protocol::CancelPlan{"P", "r"});
    REQUIRE(mcs.TrySend(request));
    REQUIRE(mcs.TrySend(request));
    CHECK(mcs.recorder.out.empty());
    CHECK(mcs.session.GetPendingCount() == 1);
}

TEST_CASE("R16 A plan is not sent again while the ACS reports isConnected=false")
{
    SendingMCS mcs(3);
    const Protocol::AcsRequest plan =
        mcs.Make(Protocol::ExecutionPlan{"P", "L", {}, {{1, "Start", "A01.SET01", {}, {}}}});
    REQUIRE(mcs.TrySend(plan));
    mcs.Text(1, MakeRequestText("AcsCommStateUpdate", R"({"isConnected":false})", "c"));
    mcs.clock.Advance(5s);
    mcs.Expire(ESessionTimer::Ack);
    CHECK(mcs.recorder.GetAll<Protocol::SendText>().empty());
    REQUIRE(mcs.GetUnanswered().size() == 1);
    CHECK(mcs.GetUnanswered()[0].attempts == 1);
}

TEST_CASE("An MCS sends its own commands only")
{
    SendingMCS mcs;
    CHECK_FALSE(mcs.TrySend(mcs.Make(Protocol::PlanReport{})));
    CHECK_FALSE(mcs.TrySend(mcs.Make(Protocol::Registration{})));
    CHECK_FALSE(mcs.TrySend(mcs.Make(Protocol::RobotPositionUpdate{})));
    CHECK(mcs.recorder.out.empty());
    CHECK(mcs.session.GetPendingCount() == 0);
    CHECK(mcs.TrySend(mcs.Make(Protocol::ExecutionPlan{})));
    CHECK(mcs.TrySend(mcs.Make(Protocol::RequestAcsErrorList{})));
    CHECK(mcs.session.GetPendingCount() == 2);
}
