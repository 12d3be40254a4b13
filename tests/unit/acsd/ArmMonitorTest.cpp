#include "ArmMonitor.hpp"

#include "Catch.hpp"

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
    ArmMonitor monitor{ArmOptions{}, outputs, controls};
    Planning::AdapterActions actions;

    /// "url args" of the MONITORs since the last call.
    std::vector<std::string> TakeMonitors()
    {
        std::vector<std::string> texts;
        for (const ArmRequest& request : std::exchange(outputs.armRequests, {}))
        {
            if (const auto* const monitorOrNull = std::get_if<OpenStream::MonitorRequest>(&request))
            {
                const std::string args = monitorOrNull->args.has_value() ? monitorOrNull->args->GetText() : "";
                texts.push_back(monitorOrNull->url + " " + args);
            }
        }
        return texts;
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
    arm.monitor.OnTaken();
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
    arm.monitor.OnTaken();
    CHECK(std::get<ArmCounted>(arm.Show("[5,5,0,11,17]")).bVerifies);
    CHECK_FALSE(arm.monitor.GetTroubleOrNull().has_value());
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
        CHECK(std::get<ArmProbed>(fact).bOnOrNone == false);
        arm.monitor.WatchCounters();
        static_cast<void>(arm.TakeMonitors());
        static_cast<void>(arm.monitor.OnProbeTimer(EArmProbe::Motor, arm.actions));
        CHECK(arm.TakeMonitors().empty()); // no counters yet
    }
    SECTION("It was taken and shows nothing: it is hidden")
    {
        arm.monitor.OnTaken();
        const ArmFact fact = arm.monitor.OnProbeTimer(EArmProbe::Motor, arm.actions);
        REQUIRE(std::holds_alternative<ArmProbed>(fact));
        CHECK_FALSE(std::get<ArmProbed>(fact).bOnOrNone.has_value());
        CHECK(arm.monitor.IsHidden(EArmProbe::Motor));
        CHECK_FALSE(arm.monitor.IsHidden(EArmProbe::Playback));
    }
    SECTION("It is slow")
    {
        static_cast<void>(arm.monitor.OnProbeTimer(EArmProbe::Motor, arm.actions));
        CHECK_FALSE(arm.monitor.IsHidden(EArmProbe::Motor));
    }
}

TEST_CASE("Relays are read range after range, and again until something else is watched")
{
    MonitorFixture arm;
    arm.BringUp();
    arm.monitor.ReadRelays({{"/project/plc/do/val_s32", 0, 1}, {"/project/plc/m/val_s32", 420, 2}});
    CHECK(arm.TakeMonitors() == std::vector<std::string>{R"(/project/plc/do/val_s32 {"st":0,"len":1})"});
    CHECK(std::holds_alternative<ArmCounted>(arm.Show("[5,5,0,11,17]")));
    arm.monitor.OnTaken();
    CHECK(std::holds_alternative<std::monostate>(arm.Show("[8]")));
    CHECK(arm.TakeMonitors() == std::vector<std::string>{R"(/project/plc/m/val_s32 {"st":420,"len":2})"});
    arm.monitor.OnTaken();
    CHECK(std::holds_alternative<std::monostate>(arm.Show("[1]")));
    const ArmFact fact = arm.Show("[1,2]");
    REQUIRE(std::holds_alternative<ArmRelaysRead>(fact));
    CHECK(std::get<ArmRelaysRead>(fact).ranges.size() == 2);
    CHECK(std::get<ArmRelaysRead>(fact).ranges[1].words == std::vector<std::int64_t>{1, 2});
    CHECK(arm.TakeMonitors().size() == 1);
    CHECK(std::holds_alternative<ArmRelaysRefused>(arm.Refuse("/project/plc/do/val_s32")));
}

} // namespace ACS::Acsd::Test
