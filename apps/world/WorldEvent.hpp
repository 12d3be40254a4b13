#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace ACS::Sim
{

/// A robot has docked: it reaches the places of these stations only. Empty: it has undocked.
struct RobotDocked
{
    std::string robotID;
    std::vector<std::string> stationIDs;

    bool operator==(const RobotDocked&) const = default;
};

/// A robot has moved the carrier, with all that is inside it, from one place to another. Each of the two is a port of the
/// robot ("LR01.CP01") or a fixed place in its reach.
struct CarrierMoved
{
    std::string robotID;
    std::string carrierID; ///< Empty in a request: any carrier at `from`. Never empty in the journal.
    std::string from;
    std::string to;

    bool operator==(const CarrierMoved&) const = default;
};

/// A robot has moved one memory ("A01.SET01.MP01", "CR01.TP01.MP01").
struct MemoryMoved
{
    std::string robotID;
    std::string from;
    std::string to;

    bool operator==(const MemoryMoved&) const = default;
};

/// A robot has opened or closed the cover of a set.
struct CoverMoved
{
    std::string robotID;
    std::string set;
    bool bClosed = false;

    bool operator==(const CoverMoved&) const = default;
};

/// A robot has pushed the start button of a place.
struct ButtonPushed
{
    std::string robotID;
    std::string place;

    bool operator==(const ButtonPushed&) const = default;
};

/// A carrier was moved by hand, not by a robot (mcs-sim --restock): it is at the place now, and the carrier that was there is
/// removed. An empty place removes the carrier from the floor; an empty carrier clears the place.
struct CarrierPlaced
{
    std::string carrierID;
    std::string place;

    bool operator==(const CarrierPlaced&) const = default;
};

enum class EMemory : std::uint8_t
{
    Unknown,
    Empty,
    Occupied,
};

/// The content of a memory place was set by hand.
struct MemoryPlaced
{
    std::string place;
    EMemory memory = EMemory::Unknown;

    bool operator==(const MemoryPlaced&) const = default;
};

/// An event on the floor: one line of the journal.
using WorldEvent =
    std::variant<RobotDocked, CarrierMoved, MemoryMoved, CoverMoved, ButtonPushed, CarrierPlaced, MemoryPlaced>;

} // namespace ACS::Sim
