#include "Catch.hpp"
#include <acs/openstream/OpenStreamCodec.hpp>

#include <string>
#include <string_view>
#include <vector>

using namespace ACS::OpenStream; // NOLINT(google-build-using-namespace)
using ACS::Core::JsonText;
using ECode = EOpenStreamErrorCode;

namespace
{

struct Refusal
{
    std::string line;
    ECode code;
};

std::string MakeMonitor(const std::string& members)
{
    return R"({"cmd":"MONITOR","payload":{)" + members + "}}";
}

std::string MakeControl(const std::string& members)
{
    return R"({"cmd":"CONTROL","payload":{)" + members + "}}";
}

std::string Encode(const OpenStreamLine& line)
{
    std::string text;
    OpenStreamCodec::EncodeLine(line, text);
    return text;
}

std::string Encode(const OpenStreamRequest& request)
{
    std::string text;
    OpenStreamCodec::EncodeRequest(request, text);
    return text;
}

std::chrono::milliseconds DecodePeriod(const std::string& number)
{
    OpenStreamCodec codec;
    const auto request = codec.DecodeRequest(MakeMonitor(R"("url":"/a","method":"GET","period_ms":)" + number));
    REQUIRE(request.has_value());
    return std::get<MonitorRequest>(*request).period;
}

} // namespace

TEST_CASE("4 Every code has a text that maps back to it, and a status")
{
    for (int number = 1; number <= static_cast<int>(ECode::Unknown); ++number)
    {
        const auto code = static_cast<ECode>(number);
        REQUIRE(GetErrorCode(GetErrorText(code)) == code);
        REQUIRE(GetErrorStatus(code) >= 400);
        REQUIRE(make_error_code(code).message() == GetErrorText(code));
    }
    REQUIRE(GetErrorCode("no_such_code") == ECode::Unknown);
    REQUIRE(GetErrorStatus(ECode::HandshakeRequired) == 412);
    REQUIRE(GetErrorScope(ECode::SessionTimeout) == EErrorScope::Fatal);
    REQUIRE(GetErrorScope(ECode::StopFailed) == EErrorScope::Fatal);
    REQUIRE(GetErrorScope(ECode::HandshakeRejected) == EErrorScope::Fatal);
}

TEST_CASE("4 Each error of a request has its own code")
{
    const std::string longURL = R"("url":"/)" + std::string(LONGEST_URL, 'a') + "\"";
    const std::string url = R"("url":"/a",)";
    const std::vector<Refusal> refusals{
        {"", ECode::InvalidNdjson},
        {"[]", ECode::InvalidNdjson},
        {"{} {}", ECode::InvalidNdjson},
        {R"({"cmd":"STOP","cmd":"STOP","payload":{}})", ECode::InvalidNdjson},
        {R"({"cmd":"STOP","payload":{"target":"monitor","x":{"a":1,"a":1}}})", ECode::InvalidNdjson},
        {R"({"cmd":"STOP","payload":{"target":NaN}})", ECode::InvalidNdjson},
        {"{\"cmd\":\"\xFF\"}", ECode::InvalidNdjson},
        {std::string(100, '['), ECode::InvalidNdjson},
        {"{}", ECode::InvalidCmd},
        {R"({"cmd":7})", ECode::InvalidCmd},
        {R"({"cmd":"monitor","payload":{}})", ECode::InvalidCmd},
        {R"({"cmd":"STOP"})", ECode::InvalidPayload},
        {R"({"cmd":"STOP","payload":null})", ECode::InvalidPayload},
        {R"({"cmd":"HANDSHAKE","payload":{}})", ECode::MissingMajor},
        {R"({"cmd":"HANDSHAKE","payload":{"major":"1"}})", ECode::InvalidMajorType},
        {R"({"cmd":"HANDSHAKE","payload":{"major":1.5}})", ECode::InvalidMajorType},
        {R"({"cmd":"HANDSHAKE","payload":{"major":-1}})", ECode::InvalidVersion},
        {R"({"cmd":"HANDSHAKE","payload":{"major":-99999999999999999999}})", ECode::InvalidVersion},
        {MakeMonitor(R"("method":1)"), ECode::MissingURL},
        {MakeMonitor(R"("stop":true)"), ECode::MissingURL},
        {MakeMonitor(R"("url":7)"), ECode::InvalidURL},
        {MakeMonitor(R"("url":"a")"), ECode::InvalidURL},
        {MakeMonitor(R"("url":"/a b")"), ECode::InvalidURL},
        {MakeMonitor(R"("url":"/a\u0000b")"), ECode::InvalidURL},
        {MakeMonitor(longURL), ECode::UrlTooLong},
        {MakeMonitor(R"("url":"/a","period_ms":"x")"), ECode::MissingMethod},
        {MakeMonitor(url + R"("method":"get","period_ms":2)"), ECode::InvalidMethod},
        {MakeMonitor(url + R"("method":"POST","period_ms":2)"), ECode::InvalidMethod},
        {MakeMonitor(url + R"("method":"GET","args":7)"), ECode::MissingPeriodMs},
        {MakeMonitor(url + R"("method":"GET","period_ms":10.5)"), ECode::InvalidPeriod},
        {MakeMonitor(url + R"("method":"GET","period_ms":"10")"), ECode::InvalidPeriod},
        {MakeMonitor(url + R"("method":"GET","period_ms":true)"), ECode::InvalidPeriod},
        {MakeMonitor(url + R"("method":"GET","period_ms":null)"), ECode::InvalidPeriod},
        {MakeMonitor(url + R"("method":"GET","period_ms":2,"args":null)"), ECode::InvalidArgs},
        {MakeMonitor(url + R"("method":"GET","period_ms":2,"args":[])"), ECode::InvalidArgs},
        {MakeControl(R"("method":"POST")"), ECode::MissingURL},
        {MakeControl(R"("url":"/a")"), ECode::MissingMethod},
        {MakeControl(url + R"("method":"GET")"), ECode::InvalidMethod},
        {MakeControl(url + R"("method":"POST","args":1,"body":1)"), ECode::InvalidArgs},
        {MakeControl(url + R"("method":"POST","body":null)"), ECode::InvalidBody},
        {MakeControl(url + R"("method":"POST","body":"x")"), ECode::InvalidBody},
        {R"({"cmd":"STOP","payload":{"id":1}})", ECode::MissingTarget},
        {R"({"cmd":"STOP","payload":{"target":"all"}})", ECode::InvalidTarget},
        {R"({"cmd":"STOP","payload":{"target":1}})", ECode::InvalidTarget},
    };
    OpenStreamCodec codec;
    for (const Refusal& refusal : refusals)
    {
        INFO(refusal.line);
        const auto request = codec.DecodeRequest(refusal.line);
        REQUIRE_FALSE(request.has_value());
        REQUIRE(GetErrorText(static_cast<ECode>(request.error().code.value())) == GetErrorText(refusal.code));
        REQUIRE(request.error().code == refusal.code);
    }
}

TEST_CASE("7.1 A period outside 2 to 30000 is clamped, before it is narrowed")
{
    REQUIRE(DecodePeriod("1") == MINIMUM_PERIOD);
    REQUIRE(DecodePeriod("-5") == MINIMUM_PERIOD);
    REQUIRE(DecodePeriod("30001") == MAXIMUM_PERIOD);
    REQUIRE(DecodePeriod("4294967298") == MAXIMUM_PERIOD);
}

TEST_CASE("7.2 A whole number passes in any spelling")
{
    REQUIRE(DecodePeriod("10.0") == std::chrono::milliseconds(10));
    REQUIRE(DecodePeriod("1e1") == std::chrono::milliseconds(10));
}

TEST_CASE("7.37 Numbers beyond 64 bits are compared by their value")
{
    REQUIRE(DecodePeriod("18446744073709551616") == MAXIMUM_PERIOD);
    REQUIRE(DecodePeriod("18446744073709551615") == MAXIMUM_PERIOD);
    REQUIRE(DecodePeriod("-1e300") == MINIMUM_PERIOD);
    REQUIRE(DecodePeriod("1e300") == MAXIMUM_PERIOD);
}

TEST_CASE("7.9 An id that is too long to be repeated in each line is ignored")
{
    const auto decodeID = [](std::size_t letters) {
        OpenStreamCodec codec;
        const auto monitor = codec.DecodeRequest(
            R"({"cmd":"MONITOR","payload":{"method":"GET","period_ms":2,"url":"/a","id":")" + std::string(letters, 'i')
            + "\"}}");
        return std::get<MonitorRequest>(monitor.value()).id;
    };
    REQUIRE(decodeID(LONGEST_ID - 2).has_value()); // its quotes count
    REQUIRE_FALSE(decodeID(LONGEST_ID - 1).has_value());
}

TEST_CASE("2 Unknown members are ignored, and the lines of the vendor's clients are decoded")
{
    OpenStreamCodec codec;
    const auto shake = codec.DecodeRequest(R"({"cmd":"HANDSHAKE","payload":{"major":1,"minor":0,"patch":0}})");
    REQUIRE(std::get<HandshakeRequest>(shake.value()).major == 1);
    const auto monitor = codec.DecodeRequest(
        R"({"cmd":"MONITOR","payload":{"args":{},"id":1,"method":"GET","period_ms":2,"url":"/project/robot"}})");
    const auto& request = std::get<MonitorRequest>(monitor.value());
    REQUIRE(request.url == "/project/robot");
    REQUIRE(request.id->GetText() == "1");
    const auto control =
        codec.DecodeRequest(R"({"x":1,"payload":{"body":[1],"method":"DELETE","url":"/a"},"cmd":"CONTROL"})");
    REQUIRE(std::get<ControlRequest>(control.value()).method == EApiMethod::Delete);
    REQUIRE(std::get<ControlRequest>(control.value()).body->GetText() == "[1]");
}

TEST_CASE("3 An encoded request decodes to the same request")
{
    const std::vector<OpenStreamRequest> requests{
        HandshakeRequest{},
        MonitorRequest{"/a?b=1", std::chrono::milliseconds(20), JsonText::FromTrusted(R"({"x":1})"), {}},
        ControlRequest{EApiMethod::Put, "/a", {}, JsonText::FromTrusted(R"({"val":"\n"})")},
        StopRequest{EStopTarget::Control},
    };
    OpenStreamCodec codec;
    for (const OpenStreamRequest& request : requests)
    {
        const std::string text = Encode(request);
        REQUIRE(text.find('\n') == text.size() - 1);
        REQUIRE(codec.DecodeRequest(text).value() == request);
    }
    REQUIRE(Encode(HandshakeRequest{}) == "{\"cmd\":\"HANDSHAKE\",\"payload\":{\"major\":1}}\n");
}

TEST_CASE("2 An encoded line of the server decodes to the same line")
{
    const std::vector<OpenStreamLine> lines{
        HandshakeAck{true, "1.0.0"},
        MonitorAck{},
        DataLine{402, 0.25, JsonText::FromTrusted("[1,2]"), {}, JsonText::FromInteger(1)},
        StopAck{EStopTarget::Session},
        ControlError{403, JsonText::FromTrusted(R"({"err_code":-38500})")},
        ErrorLine{ECode::InvalidURL, "invalid_url", "text", "hint"},
    };
    OpenStreamCodec codec;
    for (const OpenStreamLine& line : lines)
    {
        REQUIRE(codec.DecodeLine(Encode(line)).value() == line);
    }
    REQUIRE(Encode(MonitorAck{}) == "{\"type\":\"monitor_ack\"}\n");
    REQUIRE(Encode(ControlError{400, {}}) == "{\"type\":\"control_err\",\"status\":400}\n");
}

TEST_CASE("7.3 The client accepts data under both names, the server writes one")
{
    OpenStreamCodec codec;
    const auto line = codec.DecodeLine(R"({"type":"monitor_data","ts":1,"svc_dur_ms":0,"result":{}})");
    REQUIRE(std::holds_alternative<DataLine>(line.value()));
    std::string text;
    OpenStreamCodec::EncodeData(2, 0.5, ApiResponse{200, JsonText::FromTrusted("{}")}, std::nullopt, text);
    REQUIRE(text == "{\"type\":\"data\",\"ts\":2,\"svc_dur_ms\":0.5,\"result\":{}}\n");
}

TEST_CASE("7.4 The result is wrapped; without a body status takes its place and reports a failure")
{
    std::string text;
    OpenStreamCodec::EncodeData(2, 0, ApiResponse{204, {}}, std::nullopt, text);
    OpenStreamCodec::EncodeData(4, 0, ApiResponse{404, JsonText::FromInteger(1)}, JsonText::FromString("m"), text);
    REQUIRE(
        text
        == "{\"type\":\"data\",\"ts\":2,\"svc_dur_ms\":0,\"status\":204}\n"
           "{\"type\":\"data\",\"ts\":4,\"svc_dur_ms\":0,\"result\":1,\"status\":404,\"id\":\"m\"}\n");
}

TEST_CASE("1 Pretty-printed JSON of a service is written in one line")
{
    OpenStreamCodec codec;
    std::string text;
    OpenStreamCodec::EncodeData(2, 0, ApiResponse{200, JsonText::FromTrusted("{\r\n \"a\":1\n}")}, std::nullopt, text);
    REQUIRE(text.find('\n') == text.size() - 1);
    REQUIRE(std::get<DataLine>(codec.DecodeLine(text).value()).result->GetText() == R"({"a":1})");
}

TEST_CASE("7.45 The error member decides the type of a line, except in a control_err")
{
    OpenStreamCodec codec;
    const auto error = codec.DecodeLine(R"({"type":"data","error":"session_timeout","message":"m"})");
    REQUIRE(std::get<ErrorLine>(error.value()).code == ECode::SessionTimeout);
    const auto control = codec.DecodeLine(R"({"type":"control_err","status":400,"error":"x","body":null})");
    REQUIRE(std::get<ControlError>(control.value()).status == 400);
    const auto unknown = codec.DecodeLine(R"({"error":"brand_new"})");
    REQUIRE(std::get<ErrorLine>(unknown.value()).code == ECode::Unknown);
    REQUIRE(std::get<ErrorLine>(unknown.value()).codeText == "brand_new");
}

TEST_CASE("2 A text that is not a line of a server is rejected")
{
    OpenStreamCodec codec;
    for (const char* line :
         {"",
          "x",
          "[]",
          "{}",
          R"({"type":7})",
          R"({"type":"new"})",
          R"({"error":7})",
          R"({"type":"data","ts":"1"})",
          R"({"type":"stop_ack"})",
          R"({"type":"handshake_ack"})"})
    {
        INFO(line);
        REQUIRE_FALSE(codec.DecodeLine(line).has_value());
    }
}
