#pragma once

#include "IRuleControl.hpp"

namespace ACS::Testing
{

/// One vehicle at a time in each zone, a square of the floor. A vehicle takes all zones of a transport before it starts, to its parking
/// position at the end, and frees each one that it has left for the last time: so there is no deadlock.
class ZoneControl final : public IRuleControl
{
    std::vector<std::size_t> _zones;                  ///< By node; docks belong to that of their lane.
    std::vector<std::optional<std::size_t>> _holders; ///< By zone.
    std::vector<std::vector<std::size_t>> _remaining; ///< By vehicle: nodes that it still drives onto, with its own.

public:
    ZoneControl(const Floor& floor, std::size_t vehicles);

protected:
    [[nodiscard]] bool TryTakePlan(const Vehicle& vehicle, const Planning::Plan& plan) override;
    [[nodiscard]] std::size_t Grant(const Vehicle& vehicle) override;
    void OnPassed(const Vehicle& vehicle) override;

private:
    void FindZones(const Floor& floor);
};

} // namespace ACS::Testing
