// Lesson 1: a text from the MCS becomes a typed message, or an error with its place, what was expected and what was found.
//
// Decoding is the border of the SDK: it is total (any bytes give a message or a failure, nothing throws), and what has
// passed it needs no second check.

#include <acs/protocol/AcsCodec.hpp>

#include <fmt/core.h>

#include <string_view>
#include <variant>

using namespace ACS; // NOLINT(google-build-using-namespace): an example reads better without the prefix

namespace
{

constexpr std::string_view GOOD_PLAN = R"({
  "command": "ExecutionPlan",
  "transactionId": "7f1f0a52-0c3e-4d57-9a55-6f9f5b6a0001",
  "timestamp": "2025-07-02T21:00:00.123+09:00",
  "payload": {
    "planId": "PLAN-1", "lotId": "LOT-1", "priority": 10,
    "steps": [{
      "stepNo": 1, "action": "CassetteLoad", "position": "A01.CP01", "carrierIds": ["CASSETTE_01"],
      "jobs": [{"jobId": "JOB-1", "from": "A01.CP01", "to": "AMR.CP01"}]
    }]
  }
})";

/// The same with a word where the number of the step belongs.
constexpr std::string_view BROKEN_PLAN = R"({
  "command": "ExecutionPlan",
  "transactionId": "7f1f0a52-0c3e-4d57-9a55-6f9f5b6a0002",
  "timestamp": "2025-07-02T21:00:01.000+09:00",
  "payload": {
    "planId": "PLAN-2", "lotId": "LOT-1", "priority": 10,
    "steps": [{"stepNo": "first", "action": "CassetteLoad", "position": "A01.CP01", "carrierIds": [], "jobs": []}]
  }
})";

void Print(const Protocol::ExecutionPlan& plan)
{
    fmt::print("plan {} of lot {}: {} step(s)\n", plan.planID, plan.lotID, plan.steps.size());
    for (const Protocol::PlanStep& step : plan.steps)
    {
        fmt::print("  step {}: {} at {}, {} job(s)\n", step.stepNo, step.action, step.position, step.jobs.size());
    }
}

/// What could be read of the envelope survives a broken payload, so that the sender still gets his Ack.
void Print(const Protocol::DecodeFailure& failure)
{
    fmt::print("refused {} {} of plan {}\n", failure.commandName, failure.transactionID, failure.planID);
    fmt::print("  path:     {}\n", failure.error.path);
    fmt::print("  expected: {}\n", failure.error.expected);
    fmt::print("  found:    {}\n", failure.error.found);
    fmt::print("  in one sentence: {}\n", Core::Describe(failure.error));
}

} // namespace

int main()
{
    // Keep one codec and reuse it: it holds the scratch memory of its parser. Its options bound size, depth and length.
    Protocol::AcsCodec codec;

    const Protocol::DecodeOutcome good = codec.Decode(GOOD_PLAN);
    if (!good.message.has_value())
    {
        Print(good.message.error());
        return 1;
    }
    // A message is a request or an Ack; the payload of a request is a variant whose alternative is its command.
    const auto* requestOrNull = std::get_if<Protocol::AcsRequest>(&*good.message);
    if (requestOrNull == nullptr)
    {
        return 1;
    }
    const auto* planOrNull = std::get_if<Protocol::ExecutionPlan>(&requestOrNull->payload);
    if (planOrNull == nullptr)
    {
        return 1;
    }
    Print(*planOrNull);

    const Protocol::DecodeOutcome broken = codec.Decode(BROKEN_PLAN);
    if (broken.message.has_value())
    {
        return 1;
    }
    Print(broken.message.error());
    return 0;
}
