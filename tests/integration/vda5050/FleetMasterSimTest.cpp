#include "TemporaryFolder.hpp"
#include "VdaSimFixture.hpp"

#include <algorithm>
#include <csignal>
#include <fstream>

namespace ACS::Testing
{
namespace
{

/// Master control and vehicle, each in a process that can be killed.
class FleetMasterSimTest : public VdaSimFixture
{
protected:
    TemporaryFolder _folder;

    [[nodiscard]] ChildProcess MakeMaster() const
    {
        const VDA5050::OrderMessage order = MakeOrder(2); // with the rest of its route as horizon
        std::ofstream commands(_folder.GetPath() / "commands");
        commands << "order ACS/LR01 " << VDA5050::Vda5050Codec().Encode(order, VDA5050::EVda5050Version::Version200)
                 << '\n';
        commands.close();
        return ChildProcess(
            {"sh",
             "-c",
             R"(exec "$0" 127.0.0.1 "$1" "$2" < "$3")",
             ACS_FLEET_MASTER,
             std::to_string(_broker.GetPort()),
             (_folder.GetPath() / "journal").string(),
             (_folder.GetPath() / "commands").string()});
    }

    [[nodiscard]] ChildProcess MakeVehicle() const
    {
        return ChildProcess(MakeCommand(_broker.GetURL(), ACS_SITE_FILE, "LR01"));
    }

    [[nodiscard]] static bool HasPicked(const VDA5050::StateMessage& state)
    {
        const auto found = std::ranges::find(state.actionStates, "pick-1", &VDA5050::ActionState::actionID);
        return found != state.actionStates.end() && found->actionStatus == VDA5050::EActionStatus::Finished;
    }

    static void Kill(ChildProcess& program)
    {
        program.Signal(SIGKILL);
        REQUIRE(program.WaitForExitOrNull(PATIENCE) == 128 + SIGKILL);
    }
};

} // namespace

TEST_CASE_METHOD(
    FleetMasterSimTest,
    "6 A vehicle killed by SIGKILL in mid order is reported by its will, and has lost the order")
{
    ChildProcess vehicle = MakeVehicle();
    ChildProcess master = MakeMaster();
    REQUIRE(master.TryWaitForText("ACS/LR01: node N045 reached", PATIENCE));
    Kill(vehicle);
    REQUIRE(master.TryWaitForText("ACS/LR01: connection broken", PATIENCE));
    CHECK(master.GetText().find("order-1 lost") == std::string::npos); // it might still be driving
    ChildProcess reborn = MakeVehicle();
    REQUIRE(master.TryWaitForText("ACS/LR01: order-1 lost", PATIENCE));
    CHECK(master.WaitForExitOrNull(PATIENCE) == 0);
    CHECK(master.GetText().find("pick-1 finished") == std::string::npos);
}

TEST_CASE_METHOD(
    FleetMasterSimTest,
    "13 A master killed by SIGKILL while vda-sim drives resumes its order and completes it")
{
    ChildProcess vehicle = MakeVehicle();
    {
        ChildProcess master = MakeMaster();
        REQUIRE(master.TryWaitForText("ACS/LR01: node N045 reached", PATIENCE));
        Kill(master);
    }
    ChildProcess master = MakeMaster();
    REQUIRE(master.TryWaitForText("ACS/LR01: order-1 finished", PATIENCE));
    CHECK(master.WaitForExitOrNull(PATIENCE) == 0);
    CHECK_THAT(master.GetText(), Catch::Contains("action pick-1 finished"));
    // Each state that the vehicle ever sent: no error, and an action that has ended never begins again.
    REQUIRE(TryRunUntil(_context, [this]() { return HasPicked(GetLastState()); }));
    bool bEnded = false;
    for (const VDA5050::MqttMessage& message : _master->listener.messages)
    {
        if (message.topic != STATE_TOPIC)
        {
            continue;
        }
        const auto state = _codec.Decode<VDA5050::StateMessage>(message.payload);
        REQUIRE(state.has_value());
        CHECK(state->errors.empty());
        const bool bEndedNow = HasPicked(*state);
        CHECK((bEndedNow || !bEnded));
        bEnded = bEnded || bEndedNow;
    }
    CHECK(bEnded);
}

} // namespace ACS::Testing
