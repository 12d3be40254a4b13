#include "Catch.hpp"
#include "fixtures/EngineParts.hpp"
#include "fixtures/PlanWorld.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using namespace ACS::Testing;  // NOLINT(google-build-using-namespace): its fixtures

namespace
{

EngineOptions MakeChargingOptions()
{
    EngineOptions options = MakeTestOptions(false);
    options.robots.front().chargingStationID = "CHG03";
    return options;
}

void ReportBattery(EngineParts& parts, double percent, bool bCharging)
{
    parts.lr.view.state->batteryPercent = percent;
    parts.lr.view.state->bCharging = bCharging;
    parts.charging.UpdateBattery(parts.lr);
}

} // namespace

TEST_CASE("ChargingControl: with a low battery the charging station is the parking position until the resume level")
{
    EngineParts parts(MakeChargingOptions());
    parts.PutOn(parts.lr, "D-CHG01");
    parts.Discard();
    ReportBattery(parts, 20, false);
    CHECK(parts.lr.parking.homeNode == parts.FindNode("D-CHG01"));
    CHECK_FALSE(parts.engine.transaction.IsDispatchNeeded());
    ReportBattery(parts, 19, false);
    CHECK(parts.lr.parking.homeNode == parts.FindNode("D-CHG03"));
    CHECK(parts.engine.transaction.IsDispatchNeeded());
    CHECK_FALSE(parts.lr.IsFree());
    ReportBattery(parts, 79, false);
    CHECK(parts.lr.parking.homeNode == parts.FindNode("D-CHG03"));
    ReportBattery(parts, 80, false);
    CHECK(parts.lr.parking.homeNode == parts.FindNode("D-CHG01"));
    CHECK(parts.lr.IsFree());
}

TEST_CASE("ChargingControl: an idle robot at its charging station is commanded once to charge")
{
    EngineParts parts(MakeChargingOptions());
    SECTION("at the station")
    {
        parts.PutOn(parts.lr, "D-CHG03");
        parts.lr.view.state->batteryPercent = 50;
        parts.Discard();
        parts.charging.ChargeIdle();
        parts.charging.ChargeIdle();
        const CallOutcome outcome = parts.Collect();
        CHECK(outcome.ListCommands<StartCharging>().size() == 1);
        CHECK(outcome.GetDelayOrNull(EEngineTimer::ChargeRetry) == parts.engine.options.dispatch.chargeRetry);
    }
    SECTION("with a battery that is full enough")
    {
        parts.PutOn(parts.lr, "D-CHG03");
        parts.lr.view.state->batteryPercent = 80;
        parts.charging.ChargeIdle();
        CHECK(parts.Collect().ListCommands<StartCharging>().empty());
    }
    SECTION("elsewhere")
    {
        parts.PutOn(parts.lr, "D-CHG01");
        parts.lr.view.state->batteryPercent = 50;
        parts.charging.ChargeIdle();
        CHECK(parts.Collect().ListCommands<StartCharging>().empty());
    }
}

TEST_CASE("ChargingControl: a command without effect is repeated, with an alarm where the battery is low")
{
    EngineParts parts(MakeChargingOptions());
    parts.PutOn(parts.lr, "D-CHG03");
    const bool bLow = GENERATE(true, false);
    ReportBattery(parts, bLow ? 10 : 50, false);
    parts.charging.ChargeIdle();
    parts.Discard();
    parts.charging.OnChargeRetry(parts.lr);
    CHECK(
        parts.Collect().ListSetAlarms() == (bLow ? std::vector<std::string>{"ACS-1010"} : std::vector<std::string>{}));
    CHECK(parts.engine.transaction.IsDispatchNeeded());
    parts.charging.ChargeIdle();
    CHECK(parts.Collect().ListCommands<StartCharging>().size() == 1);
    ReportBattery(parts, bLow ? 10 : 50, true);
    const CallOutcome outcome = parts.Collect();
    CHECK(outcome.IsTimerCancelled(EEngineTimer::ChargeRetry));
    CHECK(outcome.ListClearedAlarms() == (bLow ? std::vector<std::string>{"ACS-1010"} : std::vector<std::string>{}));
}

TEST_CASE("ChargingControl: a robot that stops charging by itself is timed again")
{
    EngineParts parts(MakeChargingOptions());
    parts.PutOn(parts.lr, "D-CHG03");
    ReportBattery(parts, 50, true);
    parts.Discard();
    ReportBattery(parts, 51, false);
    CHECK(parts.Collect().GetDelayOrNull(EEngineTimer::ChargeRetry).has_value());
}

TEST_CASE("ChargingControl: a robot that stopped charging is commanded again once it is due, whenever that is")
{
    EngineParts parts(MakeChargingOptions());
    parts.PutOn(parts.lr, "D-CHG03");
    ReportBattery(parts, 50, true);
    SECTION("not usable when the timer expires")
    {
        ReportBattery(parts, 50, false);
        parts.lr.view.state->bSafetyStop = true;
        parts.charging.OnChargeRetry(parts.lr);
        parts.lr.view.state->bSafetyStop = false;
    }
    SECTION("full when the timer expires")
    {
        ReportBattery(parts, 100, true);
        ReportBattery(parts, 100, false);
        parts.charging.OnChargeRetry(parts.lr);
        ReportBattery(parts, 50, false);
    }
    parts.Discard();
    parts.charging.ChargeIdle();
    CHECK(parts.Collect().ListCommands<StartCharging>().size() == 1);
}

TEST_CASE("ChargingControl: a full robot that still charges is commanded once to end it")
{
    EngineParts parts(MakeChargingOptions());
    parts.PutOn(parts.lr, "D-CHG03");
    ReportBattery(parts, 10, true);
    parts.Discard();
    ReportBattery(parts, 80, true);
    parts.charging.EndCharging(parts.lr); // it drives to its parking position
    CHECK(parts.Collect().ListCommands<StopCharging>().size() == 1);
}

TEST_CASE("ChargingControl: the alarm of a charger is cleared when the battery is not low, however it was charged")
{
    EngineParts parts(MakeChargingOptions());
    parts.PutOn(parts.lr, "D-CHG03");
    ReportBattery(parts, 10, false);
    parts.charging.ChargeIdle();
    parts.charging.OnChargeRetry(parts.lr);
    REQUIRE(parts.Collect().ListSetAlarms() == std::vector<std::string>{"ACS-1010"});
    ReportBattery(parts, 79, false);
    CHECK(parts.Collect().ListClearedAlarms().empty());
    ReportBattery(parts, 80, false);
    CHECK(parts.Collect().ListClearedAlarms() == std::vector<std::string>{"ACS-1010"});
}

TEST_CASE("ChargingControl: charging ends once, and only where it was begun")
{
    EngineParts parts(MakeChargingOptions());
    parts.PutOn(parts.lr, "D-CHG03");
    parts.Discard();
    parts.charging.EndCharging(parts.lr);
    CHECK(parts.Collect().actions.empty());
    ReportBattery(parts, 50, true);
    parts.Discard();
    parts.charging.EndCharging(parts.lr);
    parts.charging.EndCharging(parts.lr);
    const CallOutcome outcome = parts.Collect();
    CHECK(outcome.ListCommands<StopCharging>().size() == 1);
    CHECK(outcome.IsTimerCancelled(EEngineTimer::ChargeRetry));
}
