#include "vda-sim/Battery.hpp"

#include "Catch.hpp"

namespace ACS::Testing
{
namespace
{

double GetCharge(const VdaSim::Battery& battery)
{
    return battery.MakeState(false).batteryCharge;
}

} // namespace

TEST_CASE("Battery: driving discharges it down to the reserve, charging fills it and no more")
{
    VdaSim::Battery battery(6.0);
    battery.Discharge(25.0);
    CHECK(GetCharge(battery) == Approx(5.5));
    battery.Discharge(1000.0);
    CHECK(GetCharge(battery) == Approx(5.0));
    battery.Charge(20.0);
    CHECK(GetCharge(battery) == Approx(15.0));
    battery.Charge(1000.0);
    CHECK(GetCharge(battery) == Approx(100.0));
}

TEST_CASE("Battery: a charge below the reserve is neither raised nor lowered by driving")
{
    VdaSim::Battery battery(100.0);
    battery.SetCharge(2.0);
    battery.Discharge(1000.0);
    CHECK(GetCharge(battery) == Approx(2.0));
}

TEST_CASE("Battery: each crossing of the low limit is a change once")
{
    VdaSim::Battery battery(VdaSim::Battery::LOW_CHARGE);
    CHECK_FALSE(battery.TryUpdateLow());
    battery.Discharge(1.0);
    CHECK(battery.TryUpdateLow());
    CHECK(battery.IsLow());
    CHECK_FALSE(battery.TryUpdateLow());
    battery.Charge(1.0);
    CHECK(battery.IsLow()); // until the next update
    CHECK(battery.TryUpdateLow());
    CHECK_FALSE(battery.IsLow());
}

TEST_CASE("Battery: its state has the reach, and whether it charges")
{
    const VDA5050::BatteryState state = VdaSim::Battery(10.03).MakeState(true);
    CHECK(state.bCharging);
    CHECK(state.reach == 501.0);
}

} // namespace ACS::Testing
