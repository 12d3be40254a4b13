#include "Catch.hpp"
#include "ControllerHarness.hpp"
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
