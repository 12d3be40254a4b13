#include "ServerPeer.hpp"

#include <array>
#include <chrono>
#include <string>
#include <string_view>
#include <vector>

/// The controller's side of the Open Stream between a client that sends anything at any time, in any pieces, a slow
/// socket, a slow service and a clock: the rules are in ServerPeer.

namespace
{

using namespace ACS;             // NOLINT(google-build-using-namespace)
using namespace ACS::OpenStream; // NOLINT(google-build-using-namespace)
using Fuzz::ExpectedAnswer;

struct ClientLine
{
    std::string_view text;
    std::vector<std::string> answers;
    bool bMaySucceedSilently = false;
    bool bCommand = true; ///< May be answered with handshake_required as well.
};

const std::vector<ClientLine>& GetClientLines()
{
    static const std::vector<ClientLine> LINES{
        {R"({"cmd":"HANDSHAKE","payload":{"major":1}})", {"handshake_ack", "busy_session_active"}, false},
        {R"({"cmd":"HANDSHAKE","payload":{"major":2}})", {"version_mismatch", "busy_session_active"}, false},
        {R"({"cmd":"HANDSHAKE","payload":{}})", {"missing_major", "busy_session_active"}, false},
        {R"({"cmd":"MONITOR","payload":{"url":"/a","method":"GET","period_ms":2}})", {"monitor_ack"}, false},
        {R"({"payload":{"id":"x","args":{"a":[1]},"url":"/b?c=d","method":"GET","period_ms":30001},"cmd":"MONITOR"})",
         {"monitor_ack"},
         false},
        {R"({"cmd":"MONITOR","payload":{"stop":true}})", {"missing_url"}, false},
        {R"({"cmd":"MONITOR","payload":{"url":"/a","method":"GET","period_ms":"2"}})", {"invalid_period"}, false},
        {R"({"cmd":"CONTROL","payload":{"url":"/a","method":"POST"}})", {"control_busy"}, true},
        {R"({"cmd":"CONTROL","payload":{"url":"/a","method":"PUT","body":[1],"args":{"a":1}}})",
         {"control_busy"},
         true},
        {R"({"cmd":"CONTROL","payload":{"url":"/a","method":"GET"}})", {"invalid_method"}, false},
        {R"({"cmd":"STOP","payload":{"target":"monitor"}})", {"stop_ack", "nothing_to_stop"}, false},
        {R"({"cmd":"STOP","payload":{"target":"control"}})", {"stop_ack", "nothing_to_stop"}, false},
        {R"({"cmd":"STOP","payload":{"target":"session"}})", {"stop_ack"}, false},
        {R"({"cmd":"STOP","payload":{"id":1}})", {"missing_target"}, false},
        {R"({"cmd":"STOP","payload":7})", {"invalid_payload"}, false},
        {R"({"cmd":"GO"})", {"invalid_cmd"}, false, false},
        {"\xFF\xFE", {"invalid_ndjson"}, false, false},
        {"[[[", {"invalid_ndjson"}, false, false},
        {R"({"cmd":"STOP","cmd":"STOP"})", {"invalid_ndjson"}, false, false},
        {"\r", {}, true, false},
        {"", {}, true, false},
    };
    return LINES;
}

/// Several lines; the last one may arrive in two pieces, with time between them.
void SendLines(Fuzz::ServerPeer& peer, Fuzz::Choices& choices)
{
    const std::vector<ClientLine>& lines = GetClientLines();
    std::string bytes;
    std::vector<ExpectedAnswer> expected;
    const std::uint32_t repeats = choices.Take(16) == 0 ? 80 : 1 + choices.Take(3);
    const ClientLine* line = nullptr;
    for (std::uint32_t count = 0; count < repeats; ++count)
    {
        if (line == nullptr || repeats < 80)
        {
            line = &lines.at(choices.Take(static_cast<std::uint32_t>(lines.size())));
        }
        bytes.append(line->text).append(choices.Take(8) == 0 ? "\r\n" : "\n");
        ExpectedAnswer answer{line->answers, line->bMaySucceedSilently};
        if (line->bCommand)
        {
            answer.kinds.emplace_back("handshake_required");
        }
        expected.push_back(std::move(answer));
    }
    const std::size_t cut = choices.Take(4) == 0 ? choices.TakeByte() % bytes.size() : 0;
    if (cut != 0 && peer.IsReading())
    {
        peer.Send(std::string_view(bytes).substr(0, cut), expected);
        if (peer.IsReading())
        {
            peer.Send(std::string_view(bytes).substr(cut), {});
            return;
        }
        peer.BreakSocket(); // the pending send fails
        return;
    }
    peer.Send(bytes, expected);
}

ApiResponse MakeResponse(Fuzz::Choices& choices)
{
    static constexpr std::array STATUSES{200, 204, 400, 403, 404, 500, 503};
    ApiResponse response{STATUSES.at(choices.Take(STATUSES.size())), {}};
    switch (choices.Take(4))
    {
        case 0:
            break;
        case 1:
            response.body = Core::JsonText::FromTrusted("{\n  \"a\": [1,\n 2]\n}\n");
            break;
        case 2:
            response.body = Core::JsonText::FromString("text with \n and \xFF");
            break;
        default:
            response.body = Core::JsonText::FromInteger(choices.TakeByte());
            break;
    }
    return response;
}

ServerSessionOptions MakeOptions(Fuzz::Choices& choices)
{
    ServerSessionOptions options;
    if (choices.Take(2) == 0)
    {
        options.maximumControls = 1 + choices.Take(4);
        options.commandsPerTurn = 1 + choices.Take(4);
    }
    options.maximumOutput = choices.Take(4) == 0 ? 400U : options.maximumOutput;
    return options;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    Fuzz::Choices choices(data, size);
    Fuzz::ServerPeer peer(MakeOptions(choices));
    while (!choices.IsUsedUp())
    {
        switch (choices.Take(12))
        {
            case 0:
            case 1:
            case 2:
                SendLines(peer, choices);
                break;
            case 3:
            case 4:
                peer.CompleteSend();
                break;
            case 5:
            case 6:
                peer.Answer(choices.TakeByte(), MakeResponse(choices));
                break;
            case 7:
                peer.Continue();
                break;
            case 8:
            case 9:
                peer.PassTime(std::chrono::milliseconds(choices.Take(8)));
                break;
            case 10:
                peer.PassTime(std::chrono::milliseconds(choices.Take(256) * 800));
                break;
            default:
                if (choices.Take(16) == 0)
                {
                    peer.ClosePeer();
                }
                else if (choices.Take(32) == 0)
                {
                    peer.BreakSocket();
                }
                break;
        }
    }
    peer.End();
    return 0;
}
