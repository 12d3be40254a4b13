#include "Catch.hpp"
#include "ServerFixture.hpp"
#include <acs/openstream/EOpenStreamErrorCode.hpp>
#include <acs/openstream/OpenStreamCodec.hpp>

#include <string>
#include <vector>

using namespace ACS::OpenStream; // NOLINT(google-build-using-namespace)
using namespace ACS::Testing;    // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;

namespace
{

struct BadLine
{
    const char* rule; ///< Section and item.
    std::string code;
    std::string line; ///< Without its end.
};

std::string MakeMonitorWith(const std::string& members)
{
    return R"({"cmd":"MONITOR","payload":{)" + members + "}}";
}

std::string MakeControlWith(const std::string& members)
{
    return R"({"cmd":"CONTROL","payload":{)" + members + "}}";
}

std::string MakeNested(std::size_t depth)
{
    // The line's own object, the payload and the body are three levels.
    const std::size_t inner = depth - 2;
    return MakeControlWith(R"("url":"/a","method":"POST","body":)" + std::string(inner, '[') + std::string(inner, ']'));
}

/// One error with this code and no other line; the stream and the session continue.
void CheckGoesOn(const BadLine& bad)
{
    INFO(bad.rule << " " << bad.line.substr(0, 200));
    ServerFixture server;
    server.Receive(HANDSHAKE);
    server.Receive(MakeMonitorLine(10));
    server.lines.clear();
    const std::size_t calls = server.calls.size();
    server.Receive(bad.line + "\n");
    REQUIRE(server.lines.size() == 1);
    CHECK(server.Count("{\"error\":\"" + bad.code + "\",\"message\":\"") == 1);
    CHECK(server.calls.size() == calls);
    CHECK(server.session.GetState() == EServerState::Streaming);
    server.Pass(20ms);
    CHECK(server.Count("\"data\"") == 2);
    CHECK(server.session.GetStats().errorLines == 1);
}

} // namespace

TEST_CASE("4 Each error of a line is answered with one error line, and the stream continues")
{
    const std::string url = R"("url":"/a",)";
    const std::string get = url + R"("method":"GET",)";
    const std::string post = url + R"("method":"POST",)";
    const std::vector<BadLine> lines{
        {"4 invalid_ndjson", "invalid_ndjson", "no JSON"},
        {"4 invalid_cmd", "invalid_cmd", R"({"payload":{}})"},
        {"4 invalid_payload", "invalid_payload", R"({"cmd":"STOP"})"},
        {"4 missing_url", "missing_url", MakeMonitorWith(R"("method":"GET","period_ms":2)")},
        {"4 invalid_url", "invalid_url", MakeControlWith(R"("url":"a","method":"POST")")},
        {"4 url_too_long", "url_too_long", MakeMonitorWith(R"("url":"/)" + std::string(LONGEST_URL, 'a') + "\"")},
        {"4 missing_method", "missing_method", MakeControlWith(R"("url":"/a")")},
        {"4 invalid_method", "invalid_method", MakeControlWith(get + R"("body":{})")},
        {"4 missing_period_ms", "missing_period_ms", MakeMonitorWith(get + R"("args":{})")},
        {"4 invalid_period", "invalid_period", MakeMonitorWith(get + R"("period_ms":"10")")},
        {"4 invalid_args", "invalid_args", MakeMonitorWith(get + R"("period_ms":2,"args":[])")},
        {"4 invalid_body", "invalid_body", MakeControlWith(post + R"("body":"x")")},
        {"4 missing_target", "missing_target", R"({"cmd":"STOP","payload":{}})"},
        {"4 invalid_target", "invalid_target", R"({"cmd":"STOP","payload":{"target":"robot"}})"},
        {"4 nothing_to_stop", "nothing_to_stop", R"({"cmd":"STOP","payload":{"target":"control"}})"},
        {"4 busy_session_active", "busy_session_active", R"({"cmd":"HANDSHAKE","payload":{"major":1}})"},
    };
    for (const BadLine& bad : lines)
    {
        CheckGoesOn(bad);
    }
}

TEST_CASE("4 Each error of a HANDSHAKE is answered with one error line, and another HANDSHAKE is accepted")
{
    const std::vector<BadLine> lines{
        {"4 missing_major", "missing_major", R"({"cmd":"HANDSHAKE","payload":{}})"},
        {"4 invalid_major_type", "invalid_major_type", R"({"cmd":"HANDSHAKE","payload":{"major":"1"}})"},
        {"4 invalid_version", "invalid_version", R"({"cmd":"HANDSHAKE","payload":{"major":-1}})"},
        {"4 version_mismatch", "version_mismatch", R"({"cmd":"HANDSHAKE","payload":{"major":2}})"},
        {"7.37", "version_mismatch", R"({"cmd":"HANDSHAKE","payload":{"major":18446744073709551617}})"},
        {"4 handshake_required", "handshake_required", R"({"cmd":"STOP","payload":{"target":"session"}})"},
    };
    for (const BadLine& bad : lines)
    {
        INFO(bad.rule);
        ServerFixture server;
        server.Receive(bad.line + "\n");
        REQUIRE(server.TakeLines().size() == 1);
        CHECK(server.session.GetStats().errorLines == 1);
        CHECK(server.session.GetState() == EServerState::Connected);
        server.Receive(bad.line + "\n" + std::string(HANDSHAKE));
        CHECK(server.Count(bad.code) == 1);
        CHECK(server.Count("handshake_ack") == 1);
        CHECK(server.session.GetState() == EServerState::Ready);
    }
}

TEST_CASE("7.2 7.8 7.23 7.29 7.30 7.31 7.32 7.34 7.35 7.36 7.37 7.38 Each bad line is answered with one error line")
{
    const std::string url = R"("url":"/a",)";
    const std::string get = url + R"("method":"GET",)";
    const std::string post = url + R"("method":"POST",)";
    const std::vector<BadLine> lines{
        {"7.2", "invalid_period", MakeMonitorWith(get + R"("period_ms":10.5)")},
        {"7.2", "invalid_period", MakeMonitorWith(get + R"("period_ms":true)")},
        {"7.2", "invalid_period", MakeMonitorWith(get + R"("period_ms":null)")},
        {"7.8", "missing_url", MakeMonitorWith(R"("stop":true)")},
        {"7.23", "missing_target", R"({"cmd":"STOP","payload":{"id":1}})"},
        {"7.29", "invalid_url", MakeControlWith(R"("url":"/a b","method":"POST")")},
        {"7.29", "invalid_url", MakeControlWith(R"("url":"/a\u007fb","method":"POST")")},
        {"7.29", "invalid_url", MakeControlWith(R"("url":"/a\nb","method":"POST")")},
        {"7.30",
         "url_too_long",
         MakeControlWith(R"("url":"/)" + std::string(LONGEST_URL, 'a') + R"(","method":"POST")")},
        {"7.31", "invalid_method", MakeMonitorWith(url + R"("method":"get","period_ms":2)")},
        {"7.31", "invalid_method", MakeControlWith(url + R"("method":"post")")},
        {"7.32", "invalid_args", MakeControlWith(post + R"("args":null)")},
        {"7.32", "invalid_body", MakeControlWith(post + R"("body":null)")},
        {"7.34", "invalid_ndjson", R"({"cmd":"STOP","payload":{"target":"monitor"})"},
        {"7.35", "invalid_ndjson", "{\"cmd\":\"STOP\",\"x\":\"\xC3\x28\"}"},
        {"7.36", "invalid_ndjson", R"({"cmd":"STOP","cmd":"STOP","payload":{"target":"monitor"}})"},
        {"7.36", "invalid_ndjson", R"({"cmd":"STOP","payload":{"target":"monitor","target":"session"}})"},
        {"7.36", "invalid_ndjson", R"({"cmd":"STOP","payload":{"target":"monitor"}} {})"},
        {"7.37", "invalid_ndjson", MakeMonitorWith(get + R"("period_ms":NaN)")},
        {"7.37", "invalid_ndjson", MakeMonitorWith(get + R"("period_ms":Infinity)")},
        {"7.37", "invalid_ndjson", MakeMonitorWith(get + R"("period_ms":-Infinity)")},
        {"7.38", "invalid_ndjson", MakeNested(DEEPEST_NESTING + 1)},
        {"7.38", "invalid_ndjson", std::string(100'000, '[')},
    };
    for (const BadLine& bad : lines)
    {
        CheckGoesOn(bad);
    }
}

TEST_CASE("7.30 7.32 7.38 A value at a limit is accepted")
{
    ServerFixture server;
    server.Receive(HANDSHAKE);
    server.Receive(MakeControlWith(R"("url":"/)" + std::string(LONGEST_URL - 1, 'a') + R"(","method":"POST")") + "\n");
    server.Receive(MakeNested(DEEPEST_NESTING) + "\n");
    server.Receive(MakeControlWith(R"("url":"/a","method":"DELETE")") + "\n");
    // 2048 bytes after decoding, more than that on the wire
    std::string escaped;
    for (std::size_t count = 1; count < LONGEST_URL; ++count)
    {
        escaped += "\\u0061";
    }
    server.Receive(MakeControlWith(R"("url":"/)" + escaped + R"(","method":"PUT")") + "\n");
    CHECK(server.calls.size() == 4);
    CHECK(server.Count("error") == 0);
}

TEST_CASE("7.1 7.37 A period beyond every integer type is clamped like any other")
{
    ServerFixture server;
    server.Receive(HANDSHAKE);
    for (const char* period : {"1", "-99999999999999999999", "0", "2.0"})
    {
        INFO(period);
        server.Receive(MakeMonitorWith(R"("url":"/a","method":"GET","period_ms":)" + std::string(period)) + "\n");
        server.lines.clear();
        server.Pass(6ms);
        CHECK(server.Count("\"data\"") == 3);
    }
    server.Receive(MakeStopLine("monitor"));
    server.Receive(MakeMonitorWith(R"("url":"/a","method":"GET","period_ms":4294967298)") + "\n");
    server.lines.clear();
    server.Pass(29'999ms);
    CHECK(server.lines.empty());
    server.Pass(1ms);
    CHECK(server.Count("\"data\"") == 1);
}

TEST_CASE("7.12 Sessions are independent: an error in one does not affect the other")
{
    ServerFixture first;
    ServerFixture second;
    first.Receive(HANDSHAKE);
    first.Receive(MakeMonitorLine(10));
    second.Receive("garbage\n" + MakeStopLine("session"));
    CHECK(second.Count("handshake_required") == 1);
    first.Pass(20ms);
    CHECK(first.Count("\"data\"") == 2);
}

TEST_CASE("7.4 A body that ends with a line end breaks no line and loses no comma")
{
    ServerFixture server;
    server.answer = ApiResponse{404, ACS::Core::JsonText::FromTrusted("{\n  \"a\": 1\n}\n")};
    server.Receive(HANDSHAKE);
    server.Receive(MakeMonitorWith(R"("url":"/a","method":"GET","period_ms":2,"id":7)") + "\n" + std::string(CONTROL));
    server.Pass(2ms);
    OpenStreamCodec codec;
    for (const std::string& line : server.lines)
    {
        INFO(line);
        CHECK(codec.DecodeLine(line).has_value());
    }
    CHECK(server.Count("\"id\":7") == 1);
    CHECK(server.Count("control_err") == 1);
}
