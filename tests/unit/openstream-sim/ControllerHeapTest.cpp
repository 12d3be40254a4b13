#include "Catch.hpp"
#include "ControllerHarness.hpp"
#include "FaultHarness.hpp"
#include "HeapProbe.hpp"

#include <array>
#include <chrono>
#include <cstdint>
#include <string_view>

using namespace ACS; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using Testing::HeapProbe;

TEST_CASE("What is read at the shortest period takes nothing from the heap")
{
    constexpr int CALLS = 1000;
    constexpr std::array<std::string_view, 4> URLS{
        "/project/robot/joints/joint_states?jno_start=1&jno_n=6",
        "/project/robot/joint_states",
        "/project/robot/po_cur",
        "/project/robot/po_cur?crd=2&task_no=0"};
    for (const std::string_view url : URLS)
    {
        INFO(url);
        Testing::ControllerHarness harness;
        OpenStream::ApiRequest request;
        OpenStream::SplitUrl(url, request);
        OpenStream::ApiResponse response;
        harness.controller.Call(request, harness.clock.GetNow(), response); // the text reaches its size
        CHECK(response.status == 200);
        const std::uint64_t before = HeapProbe::GetBlockCount();
        for (int count = 0; count < CALLS; ++count)
        {
            harness.clock.Advance(2ms);
            harness.controller.Call(request, harness.clock.GetNow(), response);
        }
        CHECK(HeapProbe::GetBlockCount() == before);
        CHECK(response.body.has_value());
    }
}

TEST_CASE("A MONITOR's tick takes nothing from the heap with faults about, nor in a silence")
{
    constexpr int CALLS = 1000;
    Testing::FaultHarness harness;
    harness.Begin("slow time=1s side=http");
    harness.Begin("refuse count=3");
    harness.Begin("estop at=1h");
    for (const std::string_view silence : {"silence at=1h", "silence"})
    {
        INFO(silence);
        harness.Begin(silence);
        OpenStream::ApiRequest request;
        OpenStream::SplitUrl("/project/robot/joint_states", request);
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
