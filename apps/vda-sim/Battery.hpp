#pragma once

#include <acs/vda5050/StateMessage.hpp>

namespace ACS::VdaSim
{

/// The battery of a vehicle: driving discharges it down to a reserve. Pure: time is a parameter, in seconds.
class Battery
{
public:
    /// %; a lower charge is reported as an error.
    static constexpr double LOW_CHARGE = 15.0;

private:
    double _charge; ///< %
    bool _bLow = false;

public:
    explicit Battery(double charge);

    void Discharge(double metres);
    void Charge(double seconds);
    /// By a fault.
    void SetCharge(double charge);

    [[nodiscard]] VDA5050::BatteryState MakeState(bool bCharging) const;

    /// Compares the charge with LOW_CHARGE; true if IsLow has changed.
    [[nodiscard]] bool TryUpdateLow();
    /// At the last TryUpdateLow.
    [[nodiscard]] bool IsLow() const noexcept;
};

} // namespace ACS::VdaSim
