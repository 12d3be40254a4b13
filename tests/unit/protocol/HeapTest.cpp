#include "AcsSamples.hpp"
#include "Catch.hpp"
#include "HeapProbe.hpp"
#include "ManualClock.hpp"
#include "SeededRandom.hpp"
#include <acs/protocol/AcsCodec.hpp>
#include <acs/protocol/AcsSession.hpp>
#include <acs/protocol/McsSession.hpp>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

using namespace ACS; // NOLINT(google-build-using-namespace)
using Protocol::AcsCodec;
using Protocol::AcsMessage;
using Protocol::AcsRequest;
using Protocol::DecodeOutcome;
using Testing::HeapProbe;

namespace
{

constexpr std::int64_t MOST_SESSION_BYTES = 64 * 1024;

std::string ReadText(const std::string& name)
{
    std::ifstream file(std::string(ACS_FIXTURES) + "/" + name + ".json", std::ios::binary);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

/// Blocks that a value itself holds.
std::uint64_t CountBlocks(const std::string& text)
{
    return text.capacity() > std::string().capacity() ? 1 : 0;
}

template <typename T, typename TCount>
std::uint64_t CountBlocks(const std::vector<T>& values, TCount countOf)
{
    std::uint64_t count = values.capacity() > 0 ? 1 : 0;
    for (const T& value : values)
    {
        count += countOf(value);
    }
    return count;
}

std::uint64_t CountBlocks(const Protocol::ExecutionPlan& plan)
{
    const auto countText = [](const std::string& text) {
        return CountBlocks(text);
    };
    const auto countJob = [](const Protocol::PlanJob& job) {
        return CountBlocks(job.jobID) + CountBlocks(job.from) + CountBlocks(job.to);
    };
    const auto countStep = [&](const Protocol::PlanStep& step) {
        return CountBlocks(step.action) + CountBlocks(step.position) + CountBlocks(step.carrierIDs, countText)
            + CountBlocks(step.jobs, countJob);
    };
    return CountBlocks(plan.planID) + CountBlocks(plan.lotID) + CountBlocks(plan.steps, countStep);
}

std::uint64_t CountBlocks(const Protocol::RobotPositionUpdate& update)
{
    return CountBlocks(update.robots, [](const Protocol::RobotPosition& robot) { return CountBlocks(robot.robotID); });
}

std::string Encode(const AcsRequest& request)
{
    std::string text;
    AcsCodec::EncodeRequest(request, text);
    return text;
}

template <typename TPayload>
void CheckDecode(const std::string& text)
{
    AcsCodec codec;
    REQUIRE(codec.Decode(text).message.has_value()); // warm-up
    const std::uint64_t before = HeapProbe::GetBlockCount();
    const DecodeOutcome outcome = codec.Decode(text);
    const std::uint64_t taken = HeapProbe::GetBlockCount() - before;
    const AcsRequest& request = std::get<AcsRequest>(outcome.message.value());
    const std::uint64_t held = CountBlocks(request.transactionID) + CountBlocks(std::get<TPayload>(request.payload));
    CHECK(held > 0);
    CHECK(taken == held);
}

/// What a session holds after it has worked for a while.
template <typename TSession, typename TOptions, typename TWork>
std::int64_t MeasureSession(const TOptions& options, TWork work)
{
    Testing::SeededRandom random;
    const std::int64_t before = HeapProbe::GetLiveBytes();
    auto session = std::make_unique<TSession>(options, random);
    {
        Protocol::SessionActions actions;
        work(*session, actions);
    }
    return HeapProbe::GetLiveBytes() - before;
}

std::string MakeAckText(const std::string& command, const std::string& transactionID)
{
    return R"({"command":")" + command + R"(Ack","transactionId":")" + transactionID
        + R"(","timestamp":"2025-07-02T21:00:00.123+09:00","result":"Success","message":"","payload":{}})";
}

} // namespace

TEST_CASE("The probe counts what is allocated and freed")
{
    const std::uint64_t blocks = HeapProbe::GetBlockCount();
    const std::int64_t bytes = HeapProbe::GetLiveBytes();
    auto text = std::make_unique<std::string>(1000, 'x');
    CHECK(HeapProbe::GetBlockCount() == blocks + 2);
    CHECK(HeapProbe::GetLiveBytes() >= bytes + 1000);
    text.reset();
    CHECK(HeapProbe::GetLiveBytes() == bytes);
}

TEST_CASE("Decoding allocates only the strings and vectors of the result")
{
    CheckDecode<Protocol::ExecutionPlan>(ReadText("ExecutionPlanCR"));
    CheckDecode<Protocol::ExecutionPlan>(Encode(Testing::MakeLargePlan()));
    CheckDecode<Protocol::RobotPositionUpdate>(Encode(Testing::MakeFiftyPositions()));
}

TEST_CASE("A message of too many values is refused before it takes memory")
{
    std::string text = "[0";
    while (text.size() < 4U * 1024U * 1024U - 8)
    {
        text += ",0";
    }
    text += "]";
    AcsCodec codec;
    const std::int64_t bytes = HeapProbe::GetLiveBytes();
    const DecodeOutcome outcome = codec.Decode(text);
    CHECK_FALSE(outcome.message.has_value());
    CHECK(HeapProbe::GetLiveBytes() - bytes < MOST_SESSION_BYTES);
}

TEST_CASE("Encoding into a reused text allocates nothing")
{
    AcsCodec codec;
    std::vector<AcsMessage> messages{Testing::MakeLargePlan(), Testing::MakeFiftyPositions()};
    for (const std::string name :
         {"ExecutionPlanCR",
          "RobotStatusUpdateCR",
          "ErrorReport",
          "RequestAcsPlanHistoryAck",
          "RequestAcsErrorListAck",
          "AcsCommStateUpdateAck"})
    {
        messages.push_back(codec.Decode(ReadText(name)).message.value());
    }
    std::string text;
    for (const AcsMessage& message : messages)
    {
        AcsCodec::Encode(message, text); // warm-up
    }
    const std::uint64_t before = HeapProbe::GetBlockCount();
    for (const AcsMessage& message : messages)
    {
        AcsCodec::Encode(message, text);
    }
    AcsCodec::EncodeRefusal("NoSuchCommandAtAll", "t", {}, "unsupported command", text);
    CHECK(HeapProbe::GetBlockCount() == before);
}

TEST_CASE("An ACS session holds less than 64 KiB besides its queues")
{
    Testing::ManualClock clock;
    const std::string plan = Encode(Testing::MakeLargePlan());
    Protocol::SessionOptions options;
    options.answerCount = 1;
    const auto work = [&](Protocol::AcsSession& session, Protocol::SessionActions& actions) {
        const Core::Now now = clock.GetNow();
        session.Start(now, actions);
        session.OnConnected(now, actions);
        session.OnText(MakeAckText("Registration", "any"), now, actions);
        REQUIRE(session.IsRegistered());
        session.ReplayDone(now, actions);
        for (int index = 0; index < 1000; ++index)
        {
            const std::string transactionID = "e2a97f63-4ed2-4d85-a2b3-11a51c18" + std::to_string(10'000 + index);
            const Protocol::PlanReport report{"PLAN-20250702-075", Protocol::EPlanStatus::InProgress, "running"};
            REQUIRE(session.TrySendDurable({transactionID, {}, report}, now, actions));
            session.OnText(MakeAckText("PlanReport", transactionID), now, actions);
            session.SendPosition(
                std::get<Protocol::RobotPositionUpdate>(Testing::MakeFiftyPositions().payload),
                now,
                actions);
            actions.clear();
        }
        session.OnText(plan, now, actions);
    };
    const std::int64_t bytes = MeasureSession<Protocol::AcsSession>(options, work);
    INFO(bytes);
    CHECK(bytes > 0);
    CHECK(bytes + static_cast<std::int64_t>(sizeof(Protocol::AcsSession)) < MOST_SESSION_BYTES);
}

TEST_CASE("An MCS session holds less than 64 KiB besides its queues")
{
    Testing::ManualClock clock;
    const std::string positions = Encode(Testing::MakeFiftyPositions());
    Protocol::McsSessionOptions options;
    options.duplicateMemory = 1;
    const auto work = [&](Protocol::McsSession& session, Protocol::SessionActions& actions) {
        const Core::Now now = clock.GetNow();
        session.OnConnected(1, now, actions);
        session.OnText(1, Encode({"r", {}, Protocol::Registration{}}), now, actions);
        REQUIRE(session.IsRegistered());
        for (int index = 0; index < 1000; ++index)
        {
            const AcsRequest request = session.MakeRequest(Testing::MakeLargePlan().payload, now);
            REQUIRE(session.TrySend(request, now, actions));
            session.OnText(1, MakeAckText("ExecutionPlan", request.transactionID), now, actions);
            session.OnText(1, positions, now, actions);
            actions.clear();
        }
    };
    const std::int64_t bytes = MeasureSession<Protocol::McsSession>(options, work);
    INFO(bytes);
    CHECK(bytes > 0);
    CHECK(bytes + static_cast<std::int64_t>(sizeof(Protocol::McsSession)) < MOST_SESSION_BYTES);
}
