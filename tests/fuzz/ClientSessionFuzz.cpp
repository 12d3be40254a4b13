#include "ClientPeer.hpp"

#include <array>
#include <chrono>
#include <string>
#include <string_view>

/// The client's side of the Open Stream between a controller that sends anything at any time, in any pieces, a slow socket, a
/// connection that fails, a caller and a clock: the rules are in ClientPeer.

namespace
{

using namespace ACS;             // NOLINT(google-build-using-namespace)
using namespace ACS::OpenStream; // NOLINT(google-build-using-namespace)
using EAnswer = Fuzz::ClientPeer::EAnswer;

/// What a controller sends that was not asked; also what violates the protocol.
constexpr std::array<std::string_view, 22> HOSTILE_LINES{
    R"({"type":"handshake_ack","ok":true,"version":"1.0.0"})",
    R"({"type":"handshake_ack","ok":false})",
    R"({"type":"monitor_ack"})",
    R"({"type":"data","ts":3,"svc_dur_ms":0.1,"result":{"a":[1]}})",
    R"({"type":"data","ts":-1e308,"svc_dur_ms":0.1,"status":404})",
    R"({"type":"data","ts":1e308,"svc_dur_ms":0.1,"result":0})",
    R"({"type":"data"})",
    R"({"type":"stop_ack","target":"monitor"})",
    R"({"type":"stop_ack","target":"control"})",
    R"({"type":"stop_ack","target":"session"})",
    R"({"type":"control_err","status":500})",
    R"({"error":"control_busy","message":"x"})",
    R"({"error":"monitor_already_active","message":"x","hint":"y"})",
    R"({"error":"invalid_ndjson"})",
    R"({"error":"monitor_internal_error"})",
    R"({"error":"nothing_to_stop"})",
    R"({"error":"session_timeout"})",
    R"({"error":"made_up"})",
    R"({"error":7})",
    "[[[",
    "\xFF\xFE",
    "",
};

/// One line, or two that follow each other for a long time, or bytes without an end.
void SendHostile(Fuzz::ClientPeer& peer, Fuzz::Choices& choices)
{
    const std::string_view first = HOSTILE_LINES.at(choices.Take(HOSTILE_LINES.size()));
    const std::string_view second = HOSTILE_LINES.at(choices.Take(HOSTILE_LINES.size()));
    std::string bytes;
    switch (choices.Take(8))
    {
        case 0:
            for (int repeat = 0; repeat < 80; ++repeat)
            {
                bytes.append(first).append("\n").append(second).append("\n");
            }
            break;
        case 1:
            bytes.append(first).append(choices.TakeByte() * 8U, 'x');
            break;
        case 2:
            bytes.append(first).append("\r\n").append(second);
            break;
        default:
            bytes.append(first).append("\n");
            break;
    }
    peer.SendHostile(bytes);
}

void Call(Fuzz::ClientPeer& peer, Fuzz::Choices& choices)
{
    switch (choices.Take(8))
    {
        case 0:
            peer.Start();
            break;
        case 1:
            peer.Stop();
            break;
        case 2:
            peer.StopControl();
            break;
        case 3:
            peer.SetMonitor(std::nullopt);
            break;
        case 4:
        case 5:
            peer.SetMonitor(std::chrono::milliseconds(choices.Take(200)));
            break;
        default:
            peer.SendControl(choices);
            break;
    }
}

ClientSessionOptions MakeOptions(Fuzz::Choices& choices)
{
    static constexpr std::array STALE_TIMES{500, 0, 150};
    static constexpr std::array LOST_TIMES{800, 0, 400};
    ClientSessionOptions options;
    options.connectTimeout = std::chrono::milliseconds(300);
    options.answerTimeout = std::chrono::milliseconds(200);
    options.controlWindow = std::chrono::milliseconds(50);
    options.staleAfter = std::chrono::milliseconds(STALE_TIMES.at(choices.Take(STALE_TIMES.size())));
    options.lostAfter = std::chrono::milliseconds(LOST_TIMES.at(choices.Take(LOST_TIMES.size())));
    options.reconnect.initial = std::chrono::milliseconds(50);
    options.reconnect.maximum = std::chrono::milliseconds(400);
    options.controlTimeout = std::chrono::milliseconds(choices.Take(8) == 1 ? 0 : 600);
    options.bSampleEvents = choices.Take(4) != 1;
    options.longestLine = 1024;
    options.maximumControls = 1 + choices.Take(4);
    options.maximumOutput = choices.Take(2) == 0 ? 200U : options.maximumOutput;
    return options;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    Fuzz::Choices choices(data, size);
    Fuzz::ClientPeer peer(MakeOptions(choices));
    peer.Start();
    while (!choices.IsUsedUp())
    {
        switch (choices.Take(16))
        {
            case 0:
            case 1:
            case 2:
                Call(peer, choices);
                break;
            case 3:
                peer.EndConnecting(choices.Take(4) != 1);
                break;
            case 4:
            case 5:
            case 6:
                peer.CompleteSend();
                break;
            case 7:
            case 8:
            case 9:
                peer.AnswerNext(EAnswer::Accepted);
                break;
            case 10:
                peer.AnswerNext(choices.Take(2) == 0 ? EAnswer::Refused : EAnswer::RefusedAsActive);
                break;
            case 11:
                peer.SendSample();
                break;
            case 12:
                SendHostile(peer, choices);
                break;
            case 13:
                peer.PassTime(std::chrono::milliseconds(choices.Take(8)));
                break;
            case 14:
                peer.PassTime(std::chrono::milliseconds(choices.TakeByte() * 4U));
                break;
            default:
                if (choices.Take(4) == 0)
                {
                    peer.ClosePeer();
                }
                else if (choices.Take(8) == 0)
                {
                    peer.BreakSocket();
                }
                break;
        }
    }
    peer.End();
    return 0;
}
