#pragma once

#include "programs/PlaceTemplate.hpp"
#include "programs/RelayName.hpp"

#include <chrono>
#include <optional>
#include <variant>
#include <vector>

namespace ACS::OpenStreamSim
{

inline constexpr int FIRST_PROGRAM = 1;
inline constexpr int LAST_PROGRAM = 9999;

/// Of several templates the first that applies names the place.
using PlaceTemplates = std::vector<PlaceTemplate>;

/// The arm moves a carrier, or a memory where the places are memory places.
struct TransferWork
{
    PlaceTemplates from;
    PlaceTemplates to;

    bool operator==(const TransferWork&) const = default;
};

/// The arm opens or closes the cover of a set.
struct CoverWork
{
    PlaceTemplates set;
    bool bClose = false;

    bool operator==(const CoverWork&) const = default;
};

/// The arm pushes the start button of a place.
struct ButtonWork
{
    PlaceTemplates place;

    bool operator==(const ButtonWork&) const = default;
};

/// What a program does on the floor; nothing that the simulator knows, for most.
using ProgramWork = std::variant<std::monostate, TransferWork, CoverWork, ButtonWork>;

/// What a program of the controller does, as far as the simulator knows: it takes its time, works and ends, well or not.
struct ProgramSpec
{
    std::chrono::milliseconds duration{2'000}; ///< Simulated.
    bool bFails = false;                       ///< Gives up at its end.
    std::optional<RelayName> echo{};           ///< The word that it echoes before it counts its start.
    ProgramWork work{};

    bool operator==(const ProgramSpec&) const = default;
};

} // namespace ACS::OpenStreamSim
