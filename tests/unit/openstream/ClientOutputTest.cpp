#include "ClientOutput.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <variant>

using namespace ACS::OpenStream; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using ACS::Core::SteadyTime;

TEST_CASE("The deadline of a request follows it from the outbox to the socket")
{
    const SteadyTime now = ACS::Testing::ManualClock().GetNow().steady;
    ClientOutput output(1000);
    ClientActions actions;
    output.SendCommand(HandshakeRequest{}, actions);
    CHECK(output.GetDeadline() == SteadyTime::max());
    output.SendUntil(ControlRequest{}, now + 2s, actions);
    output.SendUntil(ControlRequest{}, now + 1s, actions);
    CHECK(actions.size() == 1);
    CHECK(output.GetDeadline() == now + 1s);
    REQUIRE(output.TryCompleteSend());
    output.Flush(actions);
    CHECK(actions.size() == 2);
    CHECK(output.GetDeadline() == now + 1s);
    REQUIRE(output.TryCompleteSend());
    CHECK_FALSE(output.TryCompleteSend());
    CHECK(output.GetDeadline() == SteadyTime::max());
}

TEST_CASE("A command is taken when it is given to the socket, and sent when that write is complete")
{
    ClientOutput output(1000);
    ClientActions actions;
    output.SendUntil(ControlRequest{}, SteadyTime::max(), actions);
    output.SendCommand(StopRequest{EStopTarget::Session}, actions);
    CHECK_FALSE(output.WasCommandTaken());
    REQUIRE(output.TryCompleteSend());
    CHECK_FALSE(output.WasCommandTaken());
    output.Flush(actions);
    CHECK(output.WasCommandTaken());
    CHECK_FALSE(output.WasCommandSent());
    REQUIRE(output.TryCompleteSend());
    CHECK(output.WasCommandSent());
}

TEST_CASE("A STOP control drops the requests that wait, is not repeated, and precedes a command that is no CONTROL")
{
    const SteadyTime now = ACS::Testing::ManualClock().GetNow().steady;
    ClientOutput output(1000);
    ClientActions actions;
    output.SendCommand(HandshakeRequest{}, actions);
    output.SendUntil(ControlRequest{}, now + 1s, actions);
    CHECK(output.TrySendStopControl(now + 5s, actions));
    CHECK(output.GetDeadline() == now + 5s);
    CHECK_FALSE(output.TrySendStopControl(now + 6s, actions));
    CHECK(output.GetDeadline() == now + 5s);
    std::ptrdiff_t lineCount = 1;
    SECTION("a CONTROL is dropped")
    {
        output.SendCommand(ControlRequest{}, actions);
    }
    SECTION("a MONITOR is kept")
    {
        output.SendCommand(MonitorRequest{"/m", 10ms, {}, {}}, actions);
        lineCount = 2;
    }
    output.SendUntil(ControlRequest{}, SteadyTime::max(), actions);
    CHECK_FALSE(output.TrySendStopControl(SteadyTime::max(), actions));
    CHECK(output.WasCommandTaken() == (lineCount == 1));
    REQUIRE(output.TryCompleteSend());
    output.Flush(actions);
    const auto& send = std::get<ClientSend>(actions.back());
    CHECK(send.text.starts_with(R"({"cmd":"STOP")"));
    CHECK(std::ranges::count(send.text, '\n') == lineCount);
    CHECK(output.WasCommandTaken());
}
