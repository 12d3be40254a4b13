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

/// The first template that applies gives the place.
using PlaceTemplates = std::vector<PlaceTemplate>;

/// The arm moves a carrier, or a memory if the places are memory places.
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

/// The work of a program on the floor; most programs have none.
using ProgramWork = std::variant<std::monostate, TransferWork, CoverWork, ButtonWork>;

/// What the simulator knows of a program: its duration, its work and whether it fails.
struct ProgramSpec
{
    std::chrono::milliseconds duration{2'000}; ///< Simulated.
    bool bFails = false;                       ///< Fails at its end.
    std::optional<RelayName> echo{};           ///< The word that it echoes before it counts its beginning.
    ProgramWork work{};

    bool operator==(const ProgramSpec&) const = default;
};

} // namespace ACS::OpenStreamSim
