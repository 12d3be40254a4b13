#pragma once

#include "world/IWorld.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Simulation
{

/// The floor for a vehicle that carries trays itself: its cassette port (LoadPosition::port) is a tray port on
/// the floor.
class TrayPortWorld final : public Sim::IWorld
{
    Sim::IWorld& _floor;
    std::string _robotID;

public:
    /// The floor outlives it.
    TrayPortWorld(Sim::IWorld& floor, std::string robotID);

    [[nodiscard]] Core::Result<void> Act(const Sim::WorldEvent& event) override;
    [[nodiscard]] std::optional<std::string> GetCarrierOrNull(std::string_view place) override;
    [[nodiscard]] std::optional<std::string> GetPlaceOrNull(std::string_view carrierID) override;
    [[nodiscard]] Sim::EMemory GetMemory(std::string_view place) override;
    [[nodiscard]] bool IsCovered(std::string_view set) override;
    [[nodiscard]] std::vector<Sim::WorldEvent> TakeEvents() override;

private:
    [[nodiscard]] std::string Translate(std::string_view place, std::string_view from, std::string_view to) const;
};

} // namespace ACS::Simulation
