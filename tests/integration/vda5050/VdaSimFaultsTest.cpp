#include "TemporaryFolder.hpp"
#include "VdaSimFixture.hpp"

#include <algorithm>
#include <csignal>
#include <fstream>
#include <set>
#include <string>
#include <vector>

namespace ACS::Testing
{
namespace
{

using VDA5050::EActionStatus;
using VDA5050::EOperatingMode;
using VDA5050::StateMessage;

const std::string CONTROL = "vda-sim/control";
const std::string RESULT = "vda-sim/control/result";

class FaultsTest : public VdaSimFixture
{
protected:
    std::size_t _results = 0;

    FaultsTest()
    {
        _master->link.Subscribe({{RESULT, 1}});
    }

    [[nodiscard]] std::vector<std::string> With(std::vector<std::string> more) const
    {
        std::vector<std::string> command = MakeCommand(_broker.GetURL(), ACS_SITE_FILE, "LR01,protocol=2.1.0");
        command.insert(command.end(), more.begin(), more.end());
        return command;
    }

    /// What vda-sim answers to the lines.
    [[nodiscard]] std::string Command(const std::string& lines)
    {
        REQUIRE(_master->link.Publish({CONTROL, lines, 1, false}).has_value());
        ++_results;
        REQUIRE(TryRunUntil(_context, [this]() { return _master->listener.CountTopic(RESULT) == _results; }));
        return _master->listener.FindLastOrNull(RESULT)->payload;
    }

    void WaitFor(const std::function<bool(const StateMessage&)>& isSo)
    {
        REQUIRE(TryRunUntil(
            _context,
            [&]() { return _master->listener.CountTopic(STATE_TOPIC) > 0 && isSo(GetLastState()); },
            PATIENCE));
    }

    void WaitForConnection(std::string_view state)
    {
        REQUIRE(TryRunUntil(
            _context,
            [&]() {
                const VDA5050::MqttMessage* const last = _master->listener.FindLastOrNull(CONNECTION_TOPIC);
                return last != nullptr && last->payload.find(state) != std::string::npos;
            },
            PATIENCE));
    }

    [[nodiscard]] static bool HasError(const StateMessage& state, std::string_view type)
    {
        return std::ranges::find(state.errors, type, &VDA5050::VehicleError::errorType) != state.errors.end();
    }
};

} // namespace

TEST_CASE_METHOD(FaultsTest, "vda-sim: each fault is set over the control topic, shows in a state, and is cleared")
{
    ChildProcess program(With({"--fault", "LR01 battery charge=9"}));
    REQUIRE(program.TryWaitForText("ready: broker=", PATIENCE));
    WaitFor([](const StateMessage& state) {
        return state.batteryState.batteryCharge == 9.0 && HasError(state, "batteryLow");
    });

    CHECK(Command("LR01 lost") == "ok: vehicles=1 lost");
    WaitFor([](const StateMessage& state) { return !state.agvPosition->bPositionInitialized; });
    CHECK(Command("LR01 end lost") == "ok: vehicles=1 ended=1");
    WaitFor([](const StateMessage& state) { return state.agvPosition->bPositionInitialized; });

    CHECK(Command("* estop ack=REMOTE\nL* blocked\n") == "ok: vehicles=1 estop ack=REMOTE\nok: vehicles=1 blocked");
    WaitFor([](const StateMessage& state) {
        return state.safetyState.emergencyStop == VDA5050::EEmergencyStop::Remote && state.safetyState.bFieldViolation
            && HasError(state, "emergencyStop") && HasError(state, "blockedByObstacle");
    });
    CHECK(Command("LR01 end") == "ok: vehicles=1 ended=2");
    WaitFor([](const StateMessage& state) {
        return !HasError(state, "emergencyStop") && !HasError(state, "blockedByObstacle")
            && !state.safetyState.bFieldViolation;
    });

    CHECK(Command("LR01 mode mode=SERVICE for=300ms") == "ok: vehicles=1 mode mode=SERVICE for=300ms");
    WaitFor([](const StateMessage& state) { return state.operatingMode == EOperatingMode::Service; });
    WaitFor([](const StateMessage& state) { return state.operatingMode == EOperatingMode::Automatic; });

    CHECK(Command("LR01 battery charge=16") == "ok: vehicles=1 battery charge=16");
    WaitFor([](const StateMessage& state) { return !HasError(state, "batteryLow"); });

    CHECK(Command("LR01 refuse") == "ok: vehicles=1 refuse");
    Send(MakeOrder(2));
    WaitFor([](const StateMessage& state) { return HasError(state, VDA5050::ErrorTypes::ORDER_ERROR); });
    CHECK(GetLastState().orderID.empty());

    CHECK(
        Command("LR01 action-fails type=pick error=jammed\nLR01 stuck")
        == "ok: vehicles=1 action-fails type=pick error=jammed\nok: vehicles=1 stuck");
    Send(MakeOrder(2));
    Send(MakeOrder(4));
    WaitFor([](const StateMessage& state) { return state.orderID == "order-1" && state.orderUpdateID == 1; });
    CHECK_FALSE(GetLastState().bDriving);
    CHECK(Command("LR01 end stuck") == "ok: vehicles=1 ended=1");
    WaitFor([](const StateMessage& state) {
        return state.nodeStates.empty() && !state.actionStates.empty()
            && state.actionStates[0].actionStatus == EActionStatus::Failed && HasError(state, "jammed");
    });

    program.Signal(SIGTERM);
    CHECK(program.WaitForExitOrNull(PATIENCE) == 0);
    WaitForConnection("OFFLINE");
    CHECK_THAT(program.GetText(), Catch::Contains("fault begins") && Catch::Contains("fault ended"));
}

TEST_CASE_METHOD(FaultsTest, "vda-sim: after a dropped connection, with or without a will, the vehicle reconnects")
{
    ChildProcess program(With({}));
    REQUIRE(program.TryWaitForText("ready: broker=", PATIENCE));
    WaitForConnection("ONLINE");
    CHECK(Command("LR01 drop") == "ok: vehicles=1 drop");
    WaitForConnection("CONNECTIONBROKEN");
    CHECK(Command("LR01 end drop") == "ok: vehicles=1 ended=1");
    WaitForConnection("ONLINE");
    const auto countConnections = [this]() {
        return _master->listener.CountTopic(CONNECTION_TOPIC);
    };
    const std::size_t before = countConnections();
    // Without a will nothing is published at the drop; the next message is ONLINE.
    CHECK(Command("LR01 drop will=no for=300ms") == "ok: vehicles=1 drop will=no for=300ms");
    REQUIRE(TryRunUntil(
        _context,
        [&]() { return countConnections() > before; },
        PATIENCE));
    CHECK(countConnections() == before + 1);
    CHECK_THAT(_master->listener.FindLastOrNull(CONNECTION_TOPIC)->payload, Catch::Contains("\"ONLINE\""));
    // The vehicle receives orders again.
    Send(MakeOrder(2));
    WaitFor([](const StateMessage& state) { return state.lastNodeID == "N045"; });
    CHECK(Command("LR01 drop") == "ok: vehicles=1 drop");
    program.Signal(SIGTERM);
    CHECK(program.WaitForExitOrNull(PATIENCE) == 0);
}

TEST_CASE_METHOD(
    FaultsTest,
    "vda-sim: a wrong command is answered with the error, and no command of its message is executed")
{
    ChildProcess program(With({}));
    REQUIRE(program.TryWaitForText("ready: broker=", PATIENCE));
    CHECK_THAT(Command("LR01 lost\nLR01 lost for=5"), Catch::StartsWith("error: line 2, lost for: "));
    CHECK_THAT(Command("LR02 lost"), Catch::StartsWith("error: no vehicle LR02; one of the vehicles is LR01"));
    CHECK_THAT(Command("   "), Catch::StartsWith("error: "));
    CHECK_THAT(Command(std::string("\0\xff\n\r;", 5)), Catch::StartsWith("error: "));
    CHECK(Command("LR01 end") == "ok: vehicles=1 ended=0");
    CHECK(Command("LR01 trigger") == "ok: vehicles=1 triggered=0");
    CHECK_THAT(Command("LR01 stuck node=NOPE"), Catch::StartsWith("warning: vehicles=1 stuck node=NOPE; "));
    std::string many;
    for (int i = 0; i < 999; ++i)
    {
        many += "LR01 stuck at=1h\n";
    }
    CHECK_THAT(Command(many), Catch::StartsWith("ok: ") && !Catch::Contains("error"));
    CHECK(Command("LR01 lost") == "error: 1 of 1 vehicles already have 1000 faults");
    CHECK(Command("LR01 end") == "ok: vehicles=1 ended=1000");
}

TEST_CASE_METHOD(FaultsTest, "vda-sim: each vehicle of a fleet uses its version and ends with OFFLINE")
{
    const TemporaryFolder folder;
    const std::string file = (folder.GetPath() / "faults.txt").string();
    std::ofstream(file) << "# the second one\nAGV02 stuck error=jammed # for good\n";
    ChildProcess program(With(
        {"--count", "20", "--prefix", "AGV", "--type", "CR", "--seed", "3", "--no-control", "--fault-file", file}));
    REQUIRE(program.TryWaitForText("ready: broker=", PATIENCE));
    const auto getVehicles = [this](std::string_view ending, std::string_view part) {
        std::set<std::string> vehicles;
        for (const VDA5050::MqttMessage& message : _master->listener.messages)
        {
            if (message.topic.ends_with(ending) && message.payload.find(part) != std::string::npos)
            {
                vehicles.insert(message.topic);
            }
        }
        return vehicles.size();
    };
    REQUIRE(TryRunUntil(
        _context,
        [&]() { return getVehicles("/connection", "ONLINE") == 21; },
        PATIENCE));
    REQUIRE(TryRunUntil(
        _context,
        [&]() { return getVehicles("/state", "\"2.0.0\"") == 20; },
        PATIENCE));
    REQUIRE(TryRunUntil(
        _context,
        [&]() { return getVehicles("/state", "\"2.1.0\"") == 1; },
        PATIENCE));
    REQUIRE(TryRunUntil(
        _context,
        [&]() { return getVehicles("/state", "jammed") == 1; },
        PATIENCE));
    REQUIRE(TryRunUntil(
        _context,
        [&]() { return getVehicles("/factsheet", "") == 21; },
        PATIENCE));
    program.Signal(SIGTERM);
    CHECK(program.WaitForExitOrNull(PATIENCE) == 0);
    REQUIRE(TryRunUntil(
        _context,
        [&]() { return getVehicles("/connection", "OFFLINE") == 21; },
        PATIENCE));
}

} // namespace ACS::Testing
