#pragma once

#include <acs/core/ESegmentKind.hpp>
#include <acs/core/Result.hpp>

#include <string>
#include <string_view>

namespace ACS::Sim
{

/// A place of the floor in its canonical spelling: a fixed place with its area or stocker ("A01.CP01.TP01"), a port of a robot
/// ("CR01.TP01.MP01"), or a place inside a cassette that a robot carries ("LR01.CP01.TP01"), which is not a location of
/// MCS-ACS.
struct Place
{
    std::string text;
    Core::ESegmentKind kind = Core::ESegmentKind::Area; ///< Kind of the innermost segment.
    std::string robotID;                                ///< Empty for a fixed place.
    std::string station;                                ///< Where a robot docks to reach it; empty for a robot's port.

    /// Whether a carrier can be there.
    [[nodiscard]] bool IsPort() const noexcept;
    /// The port whose carrier has this place: CR01.TP01 for CR01.TP01.MP01, LR01.CP01 for LR01.CP01.TP01. Empty if the place
    /// exists without a carrier.
    [[nodiscard]] std::string GetCarrierPort() const;
};

/// Fails with EWorldError::InvalidPlace, also for the alias AMR and for a set without its area.
[[nodiscard]] Core::Result<Place> ParsePlace(std::string_view text);

} // namespace ACS::Sim
