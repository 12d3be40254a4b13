#pragma once

#include "world/Place.hpp"
#include <acs/core/Result.hpp>

#include <functional>
#include <set>
#include <string>
#include <string_view>

namespace ACS::Sim
{

/// The places that a floor has: every fixed place where none is listed, and every port of a robot none of whose ports is
/// listed. What is on a tray or inside a robot's cassette need not be listed.
class PlaceList
{
public:
    static constexpr std::size_t MAX_PLACES = 1'000'000;

private:
    std::set<std::string, std::less<>> _places; ///< With the stations of them.
    std::set<std::string, std::less<>> _owners; ///< Robots of listed ports; the empty name for fixed places.

public:
    /// A place or a range: "A01.CP01.TP01-04".
    [[nodiscard]] Core::Result<void> Add(std::string_view range);

    [[nodiscard]] bool Contains(const Place& place) const;
};

} // namespace ACS::Sim
