#pragma once

#include "world/Place.hpp"
#include <acs/core/Result.hpp>

#include <functional>
#include <set>
#include <string>
#include <string_view>

namespace ACS::Sim
{

/// The places of a floor. If no fixed place is listed, all exist; if no port of a robot is listed, all its ports exist. Places
/// on a tray or inside a robot's cassette need not be listed.
class PlaceList
{
public:
    static constexpr std::size_t MAX_PLACES = 1'000'000;

private:
    std::set<std::string, std::less<>> _places; ///< The listed places and their stations.
    std::set<std::string, std::less<>> _owners; ///< Robots of listed ports; an empty name if a fixed place is listed.

public:
    /// Adds a place or a range: "A01.CP01.TP01-04".
    [[nodiscard]] Core::Result<void> Add(std::string_view range);

    [[nodiscard]] bool Contains(const Place& place) const;
};

} // namespace ACS::Sim
