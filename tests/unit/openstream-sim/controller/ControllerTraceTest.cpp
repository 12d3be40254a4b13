#include "controller/ControllerTrace.hpp"

#include "Catch.hpp"
#include "FolderLines.hpp"
#include "ManualClock.hpp"
#include "TemporaryFolder.hpp"

#include <string>
#include <vector>

namespace ACS::OpenStreamSim
{

namespace
{

/// The lines that the calls write, without their times.
template <typename TCalls>
std::vector<std::string> ReadTrace(TCalls calls)
{
    const Testing::TemporaryFolder folder;
    const Testing::ManualClock clock;
    {
        auto trace =
            Apps::SimulatorTrace::Create("openstream-sim", {folder.GetPath().string(), {}}, clock, Core::Logger());
        REQUIRE(trace.has_value());
        calls(**trace);
    }
    std::vector<std::string> lines = Testing::ReadLines(folder.GetPath());
    for (std::string& line : lines)
    {
        const std::size_t begin = line.find(R"("program":"openstream-sim",)");
        REQUIRE(begin != std::string::npos);
        line.erase(0, begin);
    }
    return lines;
}

} // namespace

TEST_CASE("The trace has each line of each connection, with controller, connection and robot")
{
    CHECK(
        ReadTrace([](Apps::SimulatorTrace& trace) {
            ControllerTrace controller(trace, 2, "CR01");
            controller.OnReceived(1, R"({"cmd":)");
            controller.OnReceived(2, "{\"b\":1}\n");
            controller.OnReceived(1, "\"HANDSHAKE\"}\n");
            controller.OnSent(1, "{\"c\":1}\n{\"d\":2}\n");
            controller.OnReceived(1, R"({"part)");
            controller.OnClosed(1);
            controller.OnReceived(1, "{\"e\":1}\n");
            controller.OnClosed(7);
        })
        == std::vector<std::string>{
            R"("program":"openstream-sim","link":"arm","direction":"in","controller":2,"connection":2,"robot":"CR01","text":"{\"b\":1}"})",
            R"("program":"openstream-sim","link":"arm","direction":"in","controller":2,"connection":1,"robot":"CR01","text":"{\"cmd\":\"HANDSHAKE\"}"})",
            R"("program":"openstream-sim","link":"arm","direction":"out","controller":2,"connection":1,"robot":"CR01","text":"{\"c\":1}"})",
            R"("program":"openstream-sim","link":"arm","direction":"out","controller":2,"connection":1,"robot":"CR01","text":"{\"d\":2}"})",
            R"("program":"openstream-sim","link":"arm","direction":"in","controller":2,"connection":1,"robot":"CR01","text":"{\"part"})",
            R"("program":"openstream-sim","link":"arm","direction":"in","controller":2,"connection":1,"robot":"CR01","text":"{\"e\":1}"})"});
}

TEST_CASE("The trace has the requests and answers of the Open API, without their headers")
{
    CHECK(
        ReadTrace([](Apps::SimulatorTrace& trace) {
            ControllerTrace controller(trace, 1, {});
            Apps::HttpRequest request = *Apps::ParseHttpTarget("/project/plc/m/val_s32?st=400&len=1");
            request.method = "GET";
            request.headers = {{"Authorization", "Bearer secret"}};
            request.sender.authorization = "Bearer secret";
            controller.OnRequest(request);
            Apps::HttpResponse response;
            response.body = "[1]";
            response.headers = {{"Set-Cookie", "secret"}};
            controller.OnAnswer(response);
            request = *Apps::ParseHttpTarget("/project/robot/start");
            request.method = "POST";
            request.body = R"({"val":1})";
            controller.OnRequest(request);
            response.status = 403;
            response.body.clear();
            controller.OnAnswer(response);
        })
        == std::vector<std::string>{
            R"("program":"openstream-sim","link":"http","direction":"in","controller":1,"text":"GET /project/plc/m/val_s32?st=400&len=1"})",
            R"("program":"openstream-sim","link":"http","direction":"out","controller":1,"text":"200 [1]"})",
            R"("program":"openstream-sim","link":"http","direction":"in","controller":1,"text":"POST /project/robot/start {\"val\":1}"})",
            R"("program":"openstream-sim","link":"http","direction":"out","controller":1,"text":"403"})"});
}

} // namespace ACS::OpenStreamSim
