#include "Catch.hpp"
#include "controller/ControllerFixture.hpp"
#include "controller/FaultFixture.hpp"
#include "HeapProbe.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

using namespace ACS; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using Testing::HeapProbe;

namespace
{

constexpr int CALLS = 1000;
constexpr int FIRST_CALLS = 20;

/// How many blocks the calls take from the heap, 2 ms apart, after the first few, in which the text reaches its size: the
/// numbers of an arm that moves are longer than those of one that stands.
std::uint64_t CountBlocks(Testing::ControllerFixture& harness, std::string_view url)
{
    OpenStream::ApiRequest request;
    OpenStream::SplitURL(url, request);
    OpenStream::ApiResponse response;
    for (int count = 0; count < FIRST_CALLS; ++count)
    {
        harness.clock.Advance(2ms);
        harness.controller.Call(request, harness.clock.GetNow(), response);
    }
    CHECK(response.status == 200);
    const std::uint64_t before = HeapProbe::GetBlockCount();
    for (int count = 0; count < CALLS; ++count)
    {
        harness.clock.Advance(2ms);
        harness.controller.Call(request, harness.clock.GetNow(), response);
    }
    CHECK(response.body.has_value());
    return HeapProbe::GetBlockCount() - before;
}

} // namespace

TEST_CASE("What is read at the shortest period takes nothing from the heap")
{
    constexpr std::array<std::string_view, 7> URLS{
        "/project/robot/joints/joint_states?jno_start=1&jno_n=6",
        "/project/rgen",
        "/project/robot/motor_on_state",
        "/project/plc/m/val_s32?st=400&len=4",
        "/project/robot/joint_states",
        "/project/robot/po_cur",
        "/project/robot/po_cur?crd=2&task_no=0"};
    for (const std::string_view url : URLS)
    {
        INFO(url);
        Testing::ControllerFixture harness;
        CHECK(CountBlocks(harness, url) == 0);
    }
}

TEST_CASE("C.2 Nor does it while the arm follows a trajectory, whose buffer grows empty, or makes a move")
{
    constexpr std::array<std::string_view, 4> URLS{
        "/project/robot/joints/joint_states?jno_start=1&jno_n=6",
        "/project/robot/po_cur",
        "/project/robot/trajectory/joint_traject_buf_avail",
        "/project/robot/trajectory/joint_traject_mode"};
    constexpr const char* BEGINNING = R"({"interval":0.002,"look_ahead_time":60,"point":[)";
    for (const std::string_view url : URLS)
    {
        INFO(url);
        OpenStreamSim::ControllerOptions options;
        options.bWaiting = true;
        Testing::ControllerFixture harness(options);
        for (int number = 1; number <= CALLS; ++number)
        {
            const std::string body = BEGINNING + std::to_string(0.01 * number) + ",90,0,0,0,0]}";
            REQUIRE(harness.Post("/project/robot/trajectory/joint_traject_insert_point", body) == 200);
        }
        harness.clock.Advance(60s);
        CHECK(CountBlocks(harness, url) == 0);
        CHECK(harness.Contains("/project/robot/trajectory/joint_traject_buf_avail", R"("val":2048)"));
    }
    Testing::ControllerFixture harness(Testing::ControllerFixture::MakeReadyOptions());
    const std::string move = R"({"stmt":"move P,spd=2sec [40,90,0,0,0,0]"})";
    REQUIRE(harness.Post("/project/context/tasks[0]/execute_move", move) == 200);
    CHECK(CountBlocks(harness, URLS[0]) == 0);
    CHECK(harness.Contains("/project/robot/joint_states?jno_n=1", R"("position":[40])"));
}

TEST_CASE("A MONITOR's tick takes nothing from the heap with faults about, nor in a silence")
{
    Testing::FaultFixture harness;
    harness.Begin("slow time=1s side=http");
    harness.Begin("refuse count=3");
    harness.Begin("estop at=1h");
    for (const std::string_view silence : {"silence at=1h", "silence"})
    {
        INFO(silence);
        harness.Begin(silence);
        OpenStream::ApiRequest request;
        OpenStream::SplitURL("/project/robot/joint_states", request);
        OpenStream::ApiResponse response;
        harness.CallStream(request, response); // the text reaches its size
        const std::uint64_t before = HeapProbe::GetBlockCount();
        for (int count = 0; count < CALLS; ++count)
        {
            harness.clock.Advance(2ms);
            harness.CallStream(request, response);
        }
        CHECK(HeapProbe::GetBlockCount() == before);
        CHECK(response.bNoSample == (silence == "silence"));
    }
}
