#include "ClientOutput.hpp"

#include "Catch.hpp"
#include "ManualClock.hpp"

#include <algorithm>
#include <chrono>
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

TEST_CASE("A STOP control that waits is not repeated, unless a request follows it")
{
    ClientOutput output(1000);
    ClientActions actions;
    output.SendCommand(HandshakeRequest{}, actions);
    output.SendStopControl(SteadyTime::max(), actions);
    output.SendStopControl(SteadyTime::max(), actions);
    output.SendUntil(ControlRequest{}, SteadyTime::max(), actions);
    output.SendStopControl(SteadyTime::max(), actions);
    REQUIRE(output.TryCompleteSend());
    output.Flush(actions);
    const auto& send = std::get<ClientSend>(actions.back());
    CHECK(std::ranges::count(send.text, '\n') == 3);
}
