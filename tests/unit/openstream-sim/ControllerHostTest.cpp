#include "HostFixture.hpp"

#include <algorithm>
#include <memory>
#include <string>

using namespace ACS::OpenStream;    // NOLINT(google-build-using-namespace)
using namespace ACS::OpenStreamSim; // NOLINT(google-build-using-namespace)
using Fixture = ACS::Testing::HostFixture;

namespace
{

bool IsAccepted(const ClientControlSettled& settled)
{
    return settled.outcome == EControlOutcome::Accepted;
}

bool Contains(const std::string& text, const std::string& part)
{
    INFO(text);
    CHECK(text.find(part) != std::string::npos);
    return text.find(part) != std::string::npos;
}

} // namespace

TEST_CASE("3 A program is started by CONTROL, MONITOR shows its counters rise, HTTP sees the same controller")
{
    Fixture fixture;
    fixture.Monitor("/project/robot/motor_on_state", "{}");
    REQUIRE(fixture.TryAwaitSample(R"({"_type":"JObject","val":1})"));
    REQUIRE(fixture.Control("/project/robot/start", "{}").status == 403); // the motor is off
    REQUIRE(IsAccepted(fixture.Control("/project/robot/motor_on", "{}")));
    REQUIRE(fixture.TryAwaitSample(R"({"_type":"JObject","val":0})"));

    fixture.Monitor("/project/plc/m/val_s32", R"({"st":400,"len":4})");
    REQUIRE(fixture.TryAwaitSample("[0,0,0,0]"));
    REQUIRE(IsAccepted(fixture.Control("/project/context/tasks[0]/cur_prog_cnt", R"({"pno":11,"sno":0,"fno":0})")));
    REQUIRE(Contains(fixture.GetOverHttp("/project/rgen"), R"("cur_prog_no":11)"));
    REQUIRE(IsAccepted(fixture.Control("/project/robot/start", "{}")));
    REQUIRE(fixture.TryAwaitSample("[1,0,0,0]"));
    REQUIRE(fixture.TryAwaitSample("[1,1,0,11]"));
    REQUIRE(Contains(fixture.GetOverHttp("/project/plc/m/val_s32?st=400&len=4"), "\r\n\r\n[1,1,0,11]"));
}

TEST_CASE("A Over HTTP the encoded path, the status and the content type are right")
{
    Fixture fixture;
    const std::string body = R"({"pno":12})";
    const std::string selected = fixture.SendHttp(
        "POST /project/context/tasks%5B0%5D/cur_prog_cnt HTTP/1.1\r\nHost: sim\r\nConnection: close\r\n"
        "Content-Type: text/plain\r\nContent-Length: "
        + std::to_string(body.size()) + "\r\n\r\n" + body);
    REQUIRE(Contains(selected, "HTTP/1.1 200 "));
    REQUIRE(Contains(selected, "application/json; charset=utf-8"));
    REQUIRE(Contains(selected, "sno_new"));
    REQUIRE(Contains(fixture.GetOverHttp("/project/robot"), R"("cur_prog_no":12)"));
    const std::string missing = fixture.GetOverHttp("/project/nothing");
    REQUIRE(Contains(missing, "HTTP/1.1 404 "));
    REQUIRE(Contains(missing, R"("err_code":-2)"));
}

TEST_CASE("7.28 A MONITOR of an unknown path goes on and tells 404 with every sample")
{
    Fixture fixture;
    fixture.Monitor("/project/nothing", "{}");
    const auto countTold = [&fixture]() {
        return std::ranges::count_if(fixture.events, [](const ClientEvent& event) {
            const auto* const dataOrNull = std::get_if<ClientData>(&event);
            return dataOrNull != nullptr && dataOrNull->line.status == 404;
        });
    };
    REQUIRE(fixture.TryRunUntil([&countTold]() { return countTold() >= 3; }));
    fixture.Monitor("/api_ver", "{}");
    REQUIRE(fixture.TryAwaitSample("5"));
}

TEST_CASE("1 A port in use of the Open API is named; without it nothing is served")
{
    Fixture fixture;
    HostOptions options;
    options.stream.port = 0;
    options.http = fixture.host->GetHttpEndpoint();
    const std::unique_ptr<ControllerHost> second = fixture.MakeHost(options);
    const ACS::Core::Result<void> started = second->Start();
    REQUIRE_FALSE(started.has_value());
    REQUIRE(Contains(ACS::Core::Describe(started.error()), MakeText(options.http)));
    REQUIRE(second->GetStreamEndpoint().port == 0);
}
