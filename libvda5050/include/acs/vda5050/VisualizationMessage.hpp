#pragma once

#include <acs/vda5050/Header.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <optional>

namespace ACS::VDA5050
{

/// Topic visualization (section 6.13): position and velocity at a higher rate than the state, for display.
struct VisualizationMessage
{
    Header header;
    std::optional<AgvPosition> agvPosition;
    std::optional<Velocity> velocity;

    bool operator==(const VisualizationMessage&) const = default;
};

} // namespace ACS::VDA5050
