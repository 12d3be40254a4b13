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

/// Heap allocations of the calls, 2 ms apart, without the first few, in which the text reaches its size: the
/// numbers of a moving arm are longer than those of a stationary one.
std::uint64_t CountBlocks(Testing::ControllerFixture& fixture, std::string_view url)
{
    OpenStream::ApiRequest request;
    OpenStream::SplitURL(url, request);
    OpenStream::ApiResponse response;
    for (int count = 0; count < FIRST_CALLS; ++count)
    {
        fixture.clock.Advance(2ms);
        fixture.controller.Call(request, fixture.clock.GetNow(), response);
    }
    CHECK(response.status == 200);
    const std::uint64_t before = HeapProbe::GetBlockCount();
    for (int count = 0; count < CALLS; ++count)
    {
        fixture.clock.Advance(2ms);
        fixture.controller.Call(request, fixture.clock.GetNow(), response);
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
        Testing::ControllerFixture fixture;
        CHECK(CountBlocks(fixture, url) == 0);
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
        options.version = OpenStreamSim::FIRST_WITH_TRAJECTORY_MODE;
        Testing::ControllerFixture fixture(options);
        for (int number = 1; number <= CALLS; ++number)
        {
            const std::string body = BEGINNING + std::to_string(0.01 * number) + ",90,0,0,0,0]}";
            REQUIRE(fixture.Post("/project/robot/trajectory/joint_traject_insert_point", body) == 200);
        }
        fixture.clock.Advance(60s);
        CHECK(CountBlocks(fixture, url) == 0);
        CHECK(fixture.Contains("/project/robot/trajectory/joint_traject_buf_avail", R"("val":2048)"));
    }
    Testing::ControllerFixture fixture(Testing::ControllerFixture::MakeReadyOptions());
    const std::string move = R"({"stmt":"move P,spd=2sec [40,90,0,0,0,0]"})";
    REQUIRE(fixture.Post("/project/context/tasks[0]/execute_move", move) == 200);
    CHECK(CountBlocks(fixture, URLS[0]) == 0);
    CHECK(fixture.Contains("/project/robot/joint_states?jno_n=1", R"("position":[40])"));
}

TEST_CASE("A MONITOR's tick takes nothing from the heap with faults about, nor in a silence")
{
    Testing::FaultFixture fixture;
    fixture.Begin("slow time=1s side=http");
    fixture.Begin("refuse count=3");
    fixture.Begin("estop at=1h");
    for (const std::string_view silence : {"silence at=1h", "silence"})
    {
        INFO(silence);
        fixture.Begin(silence);
        OpenStream::ApiRequest request;
        OpenStream::SplitURL("/project/robot/joint_states", request);
        OpenStream::ApiResponse response;
        fixture.CallStream(request, response); // the text reaches its size
        const std::uint64_t before = HeapProbe::GetBlockCount();
        for (int count = 0; count < CALLS; ++count)
        {
            fixture.clock.Advance(2ms);
            fixture.CallStream(request, response);
        }
        CHECK(HeapProbe::GetBlockCount() == before);
        CHECK(response.bNoSample == (silence == "silence"));
    }
}
