#include "robots/ArmMonitor.hpp"

#include "Catch.hpp"

#include <chrono>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Acsd::Test
{

namespace
{

/// MONITOR alone: what is watched, and which facts the samples give.
struct MonitorFixture
{
    RobotOutputs outputs;
    ArmControls controls{outputs};
    ArmMonitor monitor;
    Planning::AdapterActions actions;
    std::uint64_t monitorCount = 0; ///< Of those that were taken.

    explicit MonitorFixture(ArmOptions options = {})
        : monitor(std::move(options), outputs, controls)
    {
    }

    /// The period of the only MONITOR since the last call of TakeMonitors.
    [[nodiscard]] std::chrono::milliseconds GetPeriod() const
    {
        REQUIRE(outputs.armRequests.size() == 1);
        return std::get<OpenStream::MonitorRequest>(outputs.armRequests.front()).period;
    }

    /// "url args" of the MONITORs since the last call.
    std::vector<std::string> TakeMonitors()
    {
        std::vector<std::string> texts;
        for (const ArmRequest& request : std::exchange(outputs.armRequests, {}))
        {
            if (const auto* const monitorOrNull = std::get_if<OpenStream::MonitorRequest>(&request))
            {
                ++monitorCount;
                const std::string args = monitorOrNull->args.has_value() ? monitorOrNull->args->GetText() : "";
                texts.push_back(monitorOrNull->url + " " + args);
            }
        }
        return texts;
    }

    /// The controller accepts the latest MONITOR, or one that many requests earlier.
    void Acknowledge(std::uint64_t before = 0)
    {
        static_cast<void>(TakeMonitors());
        monitor.OnAccepted(monitorCount - before);
    }

    ArmFact Show(std::string_view json)
    {
        return monitor.OnSample(Core::JsonText::FromTrusted(std::string(json)), actions);
    }

    /// The motor is on and counters have come.
    void BringUp()
    {
        monitor.WatchMotor(actions);
        static_cast<void>(controls.SettleOrNull({}));
        static_cast<void>(Show(R"({"val":0})"));
        static_cast<void>(Show("[5,5,0,11,17]"));
        static_cast<void>(TakeMonitors());
    }

    ArmFact Refuse(std::string url)
    {
        OpenStream::ErrorLine error;
        error.codeText = "invalid_url";
        return monitor.OnRefused({error, std::move(url)}, actions);
    }
};

const std::string COUNTERS = R"(/project/plc/m/val_s32 {"st":400,"len":5})";

} // namespace

TEST_CASE("The motor is watched until it is on, then the counters with the echo")
{
    MonitorFixture arm;
    CHECK(arm.monitor.IsLost());
    arm.monitor.WatchMotor(arm.actions);
    CHECK(arm.TakeMonitors() == std::vector<std::string>{"/project/robot/motor_on_state "});
    CHECK(std::holds_alternative<std::monostate>(arm.Show(R"({"val":1})")));
    CHECK(arm.TakeMonitors().empty());
    CHECK(std::holds_alternative<std::monostate>(arm.Show(R"({"val":0})")));
    CHECK(arm.TakeMonitors() == std::vector<std::string>{COUNTERS});
    CHECK_FALSE(arm.monitor.IsReady());
    CHECK(std::holds_alternative<std::monostate>(arm.Show("[5,5,0,11]")));
    const ArmFact fact = arm.Show("[5,4,1,11,4711]");
    REQUIRE(std::holds_alternative<ArmCounted>(fact));
    CHECK(std::get<ArmCounted>(fact).bFirst);
    CHECK(std::get<ArmCounted>(fact).sample.counters == ArmCounters{5, 4, 1});
    CHECK(std::get<ArmCounted>(fact).sample.echo == 4711);
    CHECK(arm.monitor.IsIdle());
}

TEST_CASE("Only a sample of after the MONITOR was taken again verifies a CONTROL")
{
    MonitorFixture arm;
    arm.BringUp();
    arm.monitor.VerifyCounters();
    CHECK_FALSE(arm.monitor.IsIdle());
    CHECK_FALSE(std::get<ArmCounted>(arm.Show("[5,5,0,11,17]")).bVerifies);
    arm.Acknowledge();
    CHECK(std::get<ArmCounted>(arm.Show("[5,5,0,11,17]")).bVerifies);
    CHECK_FALSE(std::get<ArmCounted>(arm.Show("[5,5,0,11,17]")).bVerifies);
    CHECK(arm.monitor.IsIdle());
}

TEST_CASE("A MONITOR of counters that is refused while a CONTROL is verified is repeated, and verifies it then")
{
    MonitorFixture arm;
    arm.BringUp();
    arm.monitor.VerifyCounters();
    static_cast<void>(arm.Refuse("/project/plc/m/val_s32"));
    REQUIRE(arm.monitor.GetTroubleOrNull().has_value());
    CHECK(arm.monitor.GetTroubleOrNull()->errorCode == "ARM-monitorRefused");
    CHECK(arm.monitor.TryRetry(arm.actions));
    arm.Acknowledge();
    CHECK(std::get<ArmCounted>(arm.Show("[5,5,0,11,17]")).bVerifies);
    CHECK_FALSE(arm.monitor.GetTroubleOrNull().has_value());
}

TEST_CASE("Counters that are refused while an effect or a probe is observed are requested again after it")
{
    MonitorFixture arm;
    arm.BringUp();
    SECTION("An effect")
    {
        arm.monitor.VerifyEffect(arm.actions);
        static_cast<void>(arm.Refuse("/project/plc/m/val_s32"));
        static_cast<void>(arm.TakeMonitors());
        CHECK(arm.monitor.TryRetry(arm.actions));
        CHECK(arm.TakeMonitors().empty());
        CHECK(std::holds_alternative<ArmEffectShown>(arm.Show(R"({"is_playback":0,"cur_prog_no":11})")));
        arm.monitor.OnEffectTimer();
        arm.Acknowledge();
        const ArmFact fact = arm.Show("[5,5,0,11,17]");
        CHECK(std::get<ArmCounted>(fact).bVerifies);
        CHECK(std::get<ArmCounted>(fact).stateOrNull.has_value());
    }
    SECTION("A probe that is not answered")
    {
        arm.monitor.BeginProbe(EArmProbe::Motor, arm.actions);
        static_cast<void>(arm.Refuse("/project/plc/m/val_s32"));
        static_cast<void>(arm.TakeMonitors());
        CHECK(arm.monitor.TryRetry(arm.actions));
        CHECK(arm.TakeMonitors().empty());
        const ArmFact fact = arm.monitor.OnProbeTimer(EArmProbe::Motor, arm.actions);
        REQUIRE(std::holds_alternative<ArmProbed>(fact));
        CHECK_FALSE(std::get<ArmProbed>(fact).bOnOrNull.has_value());
        CHECK(arm.monitor.TryRetry(arm.actions));
        CHECK(arm.TakeMonitors() == std::vector<std::string>{COUNTERS});
    }
}

TEST_CASE("An effect is watched until it is shown, refused or too late")
{
    MonitorFixture arm;
    arm.BringUp();
    arm.monitor.VerifyEffect(arm.actions);
    CHECK(arm.TakeMonitors() == std::vector<std::string>{"/project/rgen "});
    const ArmFact fact = arm.Show(R"({"is_playback":1,"cur_prog_no":11,"cur_step_no":2})");
    REQUIRE(std::holds_alternative<ArmEffectShown>(fact));
    CHECK(std::get<ArmEffectShown>(fact).state.bPlaying);
    SECTION("Shown")
    {
        arm.monitor.EndEffect(arm.actions);
    }
    SECTION("Too late")
    {
        arm.monitor.OnEffectTimer();
    }
    SECTION("Refused: then the counters alone verify")
    {
        static_cast<void>(arm.Refuse("/project/rgen"));
        CHECK(arm.TakeMonitors() == std::vector<std::string>{COUNTERS});
        arm.monitor.VerifyEffect(arm.actions);
    }
    CHECK(arm.TakeMonitors() == std::vector<std::string>{COUNTERS});
}

TEST_CASE("A probe begins only between fresh counters, and one that is not answered ends without a value")
{
    MonitorFixture arm;
    arm.BringUp();
    static_cast<void>(arm.monitor.OnProbeTimer(EArmProbe::Motor, arm.actions));
    CHECK(arm.TakeMonitors() == std::vector<std::string>{"/project/robot/motor_on_state "});
    CHECK(arm.monitor.IsProbing());
    SECTION("It is answered")
    {
        const ArmFact fact = arm.Show(R"({"val":1})");
        REQUIRE(std::holds_alternative<ArmProbed>(fact));
        CHECK(std::get<ArmProbed>(fact).bOnOrNull == false);
        arm.monitor.WatchCounters();
        static_cast<void>(arm.TakeMonitors());
        static_cast<void>(arm.monitor.OnProbeTimer(EArmProbe::Motor, arm.actions));
        CHECK(arm.TakeMonitors().empty()); // no counters yet
    }
    SECTION("It was taken and shows nothing: it is hidden")
    {
        arm.Acknowledge();
        const ArmFact fact = arm.monitor.OnProbeTimer(EArmProbe::Motor, arm.actions);
        REQUIRE(std::holds_alternative<ArmProbed>(fact));
        CHECK_FALSE(std::get<ArmProbed>(fact).bOnOrNull.has_value());
        CHECK(arm.monitor.IsHidden(EArmProbe::Motor));
        CHECK_FALSE(arm.monitor.IsHidden(EArmProbe::Playback));
    }
    SECTION("It is slow")
    {
        static_cast<void>(arm.monitor.OnProbeTimer(EArmProbe::Motor, arm.actions));
        CHECK_FALSE(arm.monitor.IsHidden(EArmProbe::Motor));
    }
}

TEST_CASE("With a slow MONITOR of the counters, effects and probes are shown soon, and counters are awaited for longer")
{
    ArmOptions slow;
    slow.period = std::chrono::seconds(30);
    MonitorFixture arm(slow);
    arm.monitor.WatchMotor(arm.actions);
    static_cast<void>(arm.controls.SettleOrNull({}));
    arm.actions.clear();
    static_cast<void>(arm.Show(R"({"val":0})"));
    REQUIRE(arm.actions.size() == 1);
    CHECK(std::get<Planning::StartAdapterTimer>(arm.actions.front()).delay > std::chrono::seconds(60));
    static_cast<void>(arm.Show("[5,5,0,11,17]"));
    static_cast<void>(arm.TakeMonitors());
    arm.monitor.VerifyEffect(arm.actions);
    CHECK(arm.GetPeriod() == std::chrono::milliseconds(100));
    static_cast<void>(arm.TakeMonitors());
    arm.monitor.BeginProbe(EArmProbe::Playback, arm.actions);
    CHECK(arm.GetPeriod() == std::chrono::milliseconds(100));
}

TEST_CASE("Relays are read range after range, and again if they are still to be read")
{
    MonitorFixture arm;
    arm.BringUp();
    arm.monitor.ReadRelays({{"/project/plc/do/val_s32", 0, 1}, {"/project/plc/m/val_s32", 420, 2}});
    CHECK(arm.TakeMonitors() == std::vector<std::string>{R"(/project/plc/do/val_s32 {"st":0,"len":1})"});
    CHECK(std::holds_alternative<std::monostate>(arm.Show("[5,5,0,11,17]")));
    arm.Acknowledge();
    CHECK(std::holds_alternative<std::monostate>(arm.Show("[8]")));
    CHECK(arm.TakeMonitors() == std::vector<std::string>{R"(/project/plc/m/val_s32 {"st":420,"len":2})"});
    arm.Acknowledge();
    CHECK(std::holds_alternative<std::monostate>(arm.Show("[1]")));
    const ArmFact fact = arm.Show("[1,2]");
    REQUIRE(std::holds_alternative<ArmRelaysRead>(fact));
    CHECK(std::get<ArmRelaysRead>(fact).ranges.size() == 2);
    CHECK(std::get<ArmRelaysRead>(fact).ranges[1].words == std::vector<std::int64_t>{1, 2});
    CHECK(arm.TakeMonitors().empty());
    CHECK(std::holds_alternative<std::monostate>(arm.Show("[3,4]")));
    arm.monitor.RepeatRelays();
    CHECK(arm.TakeMonitors() == std::vector<std::string>{R"(/project/plc/do/val_s32 {"st":0,"len":1})"});
    CHECK(std::holds_alternative<ArmRelaysRefused>(arm.Refuse("/project/plc/do/val_s32")));
}

TEST_CASE("A single range of relays comes again by itself")
{
    MonitorFixture arm;
    arm.BringUp();
    arm.monitor.ReadRelays({{"/project/plc/m/val_s32", 420, 2}});
    arm.Acknowledge();
    for (int count = 0; count < 2; ++count)
    {
        CHECK(std::holds_alternative<ArmRelaysRead>(arm.Show("[1,2]")));
        arm.monitor.RepeatRelays();
    }
    CHECK(arm.TakeMonitors().empty());
}

TEST_CASE("Samples of one range of relays are taken neither for the next range nor for the counters")
{
    MonitorFixture arm;
    arm.BringUp();
    const std::string_view firstWords = "[4711,1,2,3,4,5]";
    const std::string_view secondWords = "[7,7,7,7,7,7]";
    arm.monitor.ReadRelays({{"/project/plc/m/val_s32", 420, 6}, {"/project/plc/m/val_s32", 8000, 6}});
    arm.Acknowledge();
    static_cast<void>(arm.Show(firstWords));
    CHECK(std::holds_alternative<std::monostate>(arm.Show(firstWords)));
    arm.Acknowledge();
    const ArmFact read = arm.Show(secondWords);
    REQUIRE(std::holds_alternative<ArmRelaysRead>(read));
    CHECK(std::get<ArmRelaysRead>(read).ranges[1].words == std::vector<std::int64_t>{7, 7, 7, 7, 7, 7});
    arm.monitor.WatchCounters();
    CHECK(std::holds_alternative<std::monostate>(arm.Show(secondWords)));
    arm.Acknowledge();
    CHECK(std::holds_alternative<ArmCounted>(arm.Show("[5,5,0,11,17]")));
}

TEST_CASE("The acknowledgement of a replaced MONITOR does not count for the one that replaced it")
{
    MonitorFixture arm;
    arm.BringUp();
    SECTION("Ranges of relays")
    {
        arm.monitor.ReadRelays({{"/project/plc/do/val_s32", 0, 1}});
        arm.Acknowledge(1);
        CHECK(std::holds_alternative<std::monostate>(arm.Show("[8]")));
        arm.Acknowledge();
        CHECK(std::holds_alternative<ArmRelaysRead>(arm.Show("[8]")));
    }
    SECTION("Counters after relays")
    {
        arm.monitor.ReadRelays({{"/project/plc/m/val_s32", 420, 5}});
        arm.monitor.WatchCounters();
        arm.Acknowledge(1);
        CHECK(std::holds_alternative<std::monostate>(arm.Show("[4711,1,2,3,4]")));
        arm.Acknowledge();
        CHECK(std::holds_alternative<ArmCounted>(arm.Show("[5,5,0,11,17]")));
    }
    SECTION("The counters of after a CONTROL")
    {
        arm.monitor.VerifyEffect(arm.actions);
        arm.monitor.OnEffectTimer();
        arm.Acknowledge(1);
        CHECK_FALSE(std::get<ArmCounted>(arm.Show("[5,5,0,11,17]")).bVerifies);
        arm.Acknowledge();
        CHECK(std::get<ArmCounted>(arm.Show("[5,5,0,11,17]")).bVerifies);
    }
}

} // namespace ACS::Acsd::Test
