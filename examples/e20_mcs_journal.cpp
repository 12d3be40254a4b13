// Lesson 20: an MCS that loses no report. It writes each report to the disk before it answers Success; what it cannot write
// it answers with Fail and the reason. Killed at any moment and started again, it recognises the reports that come again (the
// ACS sends again what has no Ack): each is in the journal once. A plan is written before it is sent, and sent again with its
// transactionId until it has an Ack: the ACS recognises it, too, and executes it once.
//
//     jq -c . examples/plans/lr-cassette.json | e20_mcs_journal 9001 mcs.journal
//
// Each line of standard input is a plan: the payload of an ExecutionPlan. With MCS_TOKEN in the environment only an ACS with
// this bearer token may connect. With --die-after N the program kills itself when it has written N reports, before it answers
// the last of them: the worst moment, for a test.

#include "ExampleNumber.hpp"
#include "McsJournal.hpp"
#include "McsProgram.hpp"
#include "McsToken.hpp"
#include <acs/core/Overloaded.hpp>

#include <fmt/core.h>

#include <csignal>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <variant>

using namespace ACS;           // NOLINT(google-build-using-namespace): an example reads better without the prefix
using namespace ACS::Protocol; // NOLINT(google-build-using-namespace)

namespace
{

class JournalMCS final : public ProtocolBeast::ISessionHandler
{
    McsJournal& _journal;
    AcsCodec _codec;
    std::uint32_t _untilKill; ///< Reports; 0: it is not killed.

public:
    std::unique_ptr<ProtocolBeast::McsServer> server;

    JournalMCS(McsJournal& journal, std::uint32_t untilKill)
        : _journal(journal),
          _untilKill(untilKill)
    {
    }

    void OnSessionEvent(const SessionEvent& event) override
    {
        std::visit(
            Core::Overloaded{
                [this](const Registered& /*event*/) { SendPlans(); },
                [this](const RequestReceived& received) {
                    received.token == NO_ANSWER ? SendPlans() : OnReport(received.request, received.token);
                },
                [this](const AckReceived& received) { OnAck(received.ack); },
                [](const auto& /*other*/) { /* RequestUnanswered: the plan is sent again after the next Registered */
                }},
            event);
    }

    /// A plan. The codec checks it as a part of its message.
    void OnLine(const std::string& line)
    {
        const DecodeOutcome outcome =
            _codec.Decode(R"({"command":"ExecutionPlan","transactionId":"-","payload":)" + line + "}");
        if (!outcome.message.has_value())
        {
            fmt::print("not a plan: {}\n", Core::Describe(outcome.message.error().error));
        }
        else if (!_journal.TryAdd(server->MakeRequest(std::get<AcsRequest>(*outcome.message).payload)))
        {
            fmt::print("the plan is not sent: {}\n", McsJournal::DescribeFailure());
        }
        SendPlans();
    }

private:
    /// The server refuses plans while no ACS accepts any, and ignores one that waits for its Ack. It is asked again after each
    /// state, because an AcsCommStateUpdate may have changed that.
    void SendPlans()
    {
        for (const AcsRequest& plan : _journal.GetOpenPlans())
        {
            static_cast<void>(server->TrySend(plan));
        }
    }

    /// The loop waits for the disk here. A busy MCS writes in another thread and answers later: the token allows it.
    void OnReport(const AcsRequest& report, AnswerToken token)
    {
        EAckResult result = EAckResult::Success;
        std::string message;
        if (_journal.HasReport(report))
        {
            message = "Written before.";
        }
        else if (!_journal.TryAdd(report))
        {
            result = EAckResult::Fail; // Final: the ACS does not send it again.
            message = McsJournal::DescribeFailure();
        }
        else if (_untilKill > 0 && --_untilKill == 0)
        {
            static_cast<void>(std::raise(SIGKILL));
        }
        fmt::print("{} {}: {} {}\n", GetText(GetCommand(report)), report.transactionID, GetText(result), message);
        static_cast<void>(server->TryAnswer(token, result, message));
    }

    void OnAck(const AcsAck& ack)
    {
        fmt::print("{} of {}: {} {}\n", GetText(ack.command), ack.transactionID, GetText(ack.result), ack.message);
        if (!_journal.TryAdd(ack))
        {
            fmt::print("after a restart the plan is sent again: {}\n", McsJournal::DescribeFailure());
        }
    }
};

} // namespace

int main(int argc, char** argv) // NOLINT(bugprone-exception-escape): nothing throws here but a full memory
{
    const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
    ProtocolBeast::ServerOptions options;
    options.session.answeredByApplication = McsJournal::GetReportCommands();
    options.checkUpgrade = MakeTokenCheck(std::getenv("MCS_TOKEN")); // NOLINT(concurrency-mt-unsafe): one thread
    options.session.ackRetries = 3;                                  // Only for an ACS that recognises a repeated plan.
    std::uint32_t untilKill = 0;
    const bool bKilled = argc == 5 && std::string_view(arguments[3]) == "--die-after";
    if ((argc != 3 && !bKilled) || !TryRead(arguments[1], options.port)
        || (bKilled && !TryRead(arguments[4], untilKill)))
    {
        fmt::print("Usage: e20_mcs_journal PORT JOURNAL [--die-after N]   (port 0: a free one)\n");
        return 2;
    }
    McsJournal journal;
    if (!journal.TryOpen(arguments[2]))
    {
        fmt::print("{}: {}\n", arguments[2], McsJournal::DescribeFailure());
        return 2;
    }
    JournalMCS mcs(journal, untilKill);
    return RunMCS(options, mcs, mcs.server, [&mcs](const std::string& line) { mcs.OnLine(line); });
}
