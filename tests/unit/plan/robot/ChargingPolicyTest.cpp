#include "robot/ChargingPolicy.hpp"

#include "Catch.hpp"

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using EBatteryChange = ChargingPolicy::EBatteryChange;
using EChargingChange = ChargingPolicy::EChargingChange;

TEST_CASE("ChargingPolicy: a battery is low below the floor and stays so up to the resume level")
{
    DispatchOptions limits;
    limits.batteryFloor = 20;
    limits.batteryResume = 80;
    ChargingPolicy policy;
    CHECK(policy.UpdateBattery(20, false, limits) == EBatteryChange::None);
    CHECK_FALSE(policy.IsBatteryLow());
    CHECK(policy.UpdateBattery(19.9, false, limits) == EBatteryChange::Low);
    CHECK(policy.UpdateBattery(79.9, false, limits) == EBatteryChange::None);
    CHECK(policy.IsBatteryLow());
    CHECK(policy.UpdateBattery(80, false, limits) == EBatteryChange::Charged);
    CHECK_FALSE(policy.IsBatteryLow());
    CHECK(policy.UpdateBattery(79.9, false, limits) == EBatteryChange::None);
}

TEST_CASE("ChargingPolicy: a robot that is recharged when it reports first has a low battery up to the resume level")
{
    DispatchOptions limits;
    limits.batteryFloor = 20;
    limits.batteryResume = 80;
    ChargingPolicy policy;
    SECTION("only then")
    {
        CHECK(policy.UpdateBattery(50, false, limits) == EBatteryChange::None);
        CHECK(policy.UpdateBattery(50, true, limits) == EBatteryChange::None);
    }
    SECTION("below the resume level")
    {
        CHECK(policy.UpdateBattery(50, true, limits) == EBatteryChange::Low);
        CHECK(policy.UpdateBattery(80, true, limits) == EBatteryChange::Charged);
    }
    SECTION("not at it")
    {
        CHECK(policy.UpdateBattery(80, true, limits) == EBatteryChange::None);
    }
    CHECK(policy.UpdateBattery(79, true, limits) == EBatteryChange::None);
}

TEST_CASE("ChargingPolicy: charging is commanded once, and again after a repeat")
{
    ChargingPolicy policy;
    CHECK_FALSE(policy.TryRepeat());
    CHECK(policy.TryBegin());
    CHECK_FALSE(policy.TryBegin());
    CHECK(policy.TryRepeat());
    CHECK(policy.TryBegin());
}

TEST_CASE("ChargingPolicy: a robot that charges is not commanded to, and an interruption is noticed once")
{
    ChargingPolicy policy;
    CHECK(policy.UpdateCharging(false) == EChargingChange::None);
    CHECK(policy.UpdateCharging(true) == EChargingChange::Begun);
    CHECK(policy.UpdateCharging(true) == EChargingChange::None);
    CHECK(policy.IsCommanded());
    CHECK_FALSE(policy.TryBegin());
    CHECK_FALSE(policy.TryRepeat());

    CHECK(policy.UpdateCharging(false) == EChargingChange::Interrupted);
    CHECK(policy.UpdateCharging(false) == EChargingChange::None);
    CHECK_FALSE(policy.TryBegin());
    CHECK(policy.TryRepeat());
}

TEST_CASE("ChargingPolicy: charging is stopped only if it was commanded or shown")
{
    ChargingPolicy policy;
    CHECK_FALSE(policy.TryEnd());
    static_cast<void>(policy.UpdateCharging(true));
    CHECK(policy.TryEnd());
    CHECK_FALSE(policy.TryEnd());

    SECTION("a lost connection leaves nothing to stop, and the battery low")
    {
        static_cast<void>(policy.UpdateBattery(1, false, {}));
        static_cast<void>(policy.TryBegin());
        policy.OnLinkLost();
        CHECK_FALSE(policy.IsCommanded());
        CHECK_FALSE(policy.TryEnd());
        CHECK(policy.IsBatteryLow());
    }
}
