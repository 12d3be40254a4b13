#pragma once

#include "VehicleMaps.hpp"
#include <acs/vda5050/OrderValidator.hpp>
#include <acs/vda5050/StateMessage.hpp>
#include <acs/vda5050/VehicleOptions.hpp>
#include <acs/vda5050/VisualizationMessage.hpp>

#include <optional>
#include <string>
#include <vector>

namespace ACS::VDA5050
{

/// What the owner of a vehicle session reports of the vehicle, as states show it, with the effects of finished actions. False of
/// a TryChange: nothing has changed that a state must show soon.
class OwnerReports
{
    const VehicleOptions& _options;
    std::optional<AgvPosition> _position;
    std::optional<Velocity> _velocity;
    std::optional<double> _distanceSinceLastNode;
    std::optional<std::vector<Load>> _loads;
    VehicleMaps _maps;
    BatteryState _battery;
    SafetyState _safety;
    std::vector<VehicleError> _errors;
    std::vector<Information> _information;
    EOperatingMode _operatingMode = EOperatingMode::Automatic;

public:
    /// The options must outlive the reports.
    explicit OwnerReports(const VehicleOptions& options);

    void SetPosition(
        const AgvPosition& position,
        const Velocity& velocity,
        std::optional<double> distanceSinceLastNodeOrNull);
    /// The last node is another one, or is left at another time, than the distance was measured from.
    void ResetDistance();
    void SetInformation(std::vector<Information> information);
    [[nodiscard]] bool TryChangeBattery(const BatteryState& battery);
    [[nodiscard]] bool TryChangeLoads(std::optional<std::vector<Load>> loadsOrNull);
    [[nodiscard]] bool TryChangeMaps(std::optional<std::vector<MapState>> mapsOrNull);
    [[nodiscard]] bool TryChangeErrors(std::vector<VehicleError> errors);
    [[nodiscard]] bool TryChangeSafety(const SafetyState& safety);
    [[nodiscard]] bool TryChangeMode(EOperatingMode mode);
    /// Why an action fails before it begins, by what was reported; empty where it may begin. An instant action is refused a new
    /// position during an order.
    [[nodiscard]] std::string FindFault(const Action& action, bool bPositionFixed) const;
    /// Why an action that the owner reports as finished has failed; empty if it has not.
    [[nodiscard]] std::string FindEndFault(const Action& action) const;
    void Apply(const Action& action);

    [[nodiscard]] EOperatingMode GetMode() const noexcept;
    /// Whether the mode lets master control move the vehicle.
    [[nodiscard]] bool IsLed() const noexcept;
    /// The owner reports a position that is not initialised.
    [[nodiscard]] bool IsPositionLost() const noexcept;
    /// Nullopt: the position is unknown.
    [[nodiscard]] std::optional<VisualizationMessage> MakeVisualizationOrNull() const;
    void Fill(StateMessage& state) const;
    void Fill(OrderContext& context) const;

private:
    [[nodiscard]] std::string FindPoseFault(const Action& action, bool bPositionFixed) const;
};

} // namespace ACS::VDA5050
