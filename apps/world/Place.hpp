#pragma once

#include <acs/core/ESegmentKind.hpp>
#include <acs/core/Result.hpp>

#include <string>
#include <string_view>

namespace ACS::Sim
{

/// A place of the floor in its canonical spelling: a fixed one with its area or stocker ("A01.CP01.TP01"), a port of a robot
/// ("CR01.TP01.MP01"), or what no location of MCS-ACS can name, a place inside a cassette that a robot carries
/// ("LR01.CP01.TP01").
struct Place
{
    std::string text;
    Core::ESegmentKind kind = Core::ESegmentKind::Area; ///< Of the innermost segment.
    std::string robotID;                                ///< Empty: a fixed place.
    std::string station;                                ///< Where a robot docks for it; empty: a robot's port.

    /// Whether a carrier can be there.
    [[nodiscard]] bool IsPort() const noexcept;
    /// The port whose carrier has this place: CR01.TP01 of CR01.TP01.MP01, LR01.CP01 of LR01.CP01.TP01. Empty where the place
    /// is there without a carrier.
    [[nodiscard]] std::string GetCarrierPort() const;
};

/// Fails with EWorldError::InvalidPlace, also for the alias AMR and for a set without its area.
[[nodiscard]] Core::Result<Place> ParsePlace(std::string_view text);

} // namespace ACS::Sim
