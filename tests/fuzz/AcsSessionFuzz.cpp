#include "AcsPeer.hpp"

#include <array>
#include <string>

/// The ACS side of MCS-ACS between an MCS that sends anything at any time, a connection that fails, a user and a clock: the rules
/// are in AcsPeer.

namespace
{

using namespace ACS;           // NOLINT(google-build-using-namespace)
using namespace ACS::Protocol; // NOLINT(google-build-using-namespace)

/// Of an MCS: valid, repeated, of the wrong side, malformed.
std::string MakeText(Fuzz::Choices& choices)
{
    static constexpr std::array<std::string_view, 6> FIXED{
        "",
        "[]",
        R"({"header":{"command":"Unknown","transactionId":"x"}})",
        R"({"header":1})",
        "\xFF{",
        R"({"header":{}})"};
    const std::uint32_t kind = choices.Take(FIXED.size() + 8);
    if (kind < FIXED.size())
    {
        return std::string(FIXED.at(kind));
    }
    const std::string transactionID = "m" + std::to_string(choices.Take(8));
    const std::string planID = "P" + std::to_string(choices.Take(4));
    std::string text;
    switch (kind - FIXED.size())
    {
        case 0:
            AcsCodec::EncodeRequest({transactionID, {}, CancelPlan{planID, {}}}, text);
            break;
        case 1:
            AcsCodec::EncodeRequest({transactionID, {}, RequestAcsPlans{}}, text);
            break;
        case 2:
            AcsCodec::EncodeRequest({transactionID, {}, SyncConfig{}}, text);
            break;
        case 3:
            AcsCodec::EncodeRequest({transactionID, {}, PlanReport{planID, EPlanStatus::Completed, {}}}, text);
            break;
        case 4:
            AcsCodec::EncodeRequest({transactionID, {}, ExecutionPlan{}}, text);
            break;
        default:
        {
            AcsAck ack;
            ack.command = static_cast<EAcsCommand>(choices.Take(COMMAND_COUNT));
            ack.transactionID = choices.Take(2) == 0 ? transactionID : "t" + std::to_string(choices.Take(16));
            ack.result = choices.Take(2) == 0 ? EAckResult::Success : EAckResult::Fail;
            AcsCodec::EncodeAck(ack, text);
            break;
        }
    }
    if (choices.Take(8) == 0 && !text.empty())
    {
        text.resize(choices.TakeByte() % text.size()); // cut off
    }
    return text;
}

SessionOptions MakeOptions(Fuzz::Choices& choices)
{
    SessionOptions options;
    options.window = 1 + choices.Take(4);
    options.ackRetries = choices.Take(3);
    options.ackDeadAfter = 1 + choices.Take(4);
    options.bAcksMatchedByCommand = choices.Take(2) == 0;
    options.answerCount = 1 + choices.Take(4);
    return options;
}

void Step(Fuzz::AcsPeer& peer, Fuzz::Choices& choices)
{
    switch (choices.Take(16))
    {
        case 0:
            peer.Start();
            break;
        case 1:
        case 2:
            peer.Connect();
            break;
        case 3:
        case 4:
        case 5:
            peer.Acknowledge(choices.TakeByte(), choices.Take(8) == 0 ? EAckResult::Fail : EAckResult::Success);
            break;
        case 6:
        case 7:
            peer.Receive(MakeText(choices));
            break;
        case 8:
        case 9:
            peer.SendReport();
            break;
        case 10:
            peer.SendStatus(choices.Take(3), choices.Take(3));
            break;
        case 11:
            peer.SendPosition();
            break;
        case 12:
            peer.FinishReplay();
            break;
        case 13:
            peer.PassTime(std::chrono::milliseconds(choices.TakeByte() * 40));
            break;
        case 14:
            peer.CloseConnection();
            break;
        default:
            if (choices.Take(8) == 0)
            {
                peer.Stop();
            }
            break;
    }
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    Fuzz::Choices choices(data, size);
    Fuzz::AcsPeer peer(MakeOptions(choices));
    peer.Start();
    while (!choices.IsUsedUp())
    {
        Step(peer, choices);
    }
    return 0;
}
