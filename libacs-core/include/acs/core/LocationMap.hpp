#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Location.hpp>
#include <acs/core/Result.hpp>
#include <acs/core/RobotID.hpp>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <unordered_set>

namespace ACS::Core
{

/// The places of a site: fixed places and the ports of its robots (section 10). Any site size and numbering is possible.
class ACS_API LocationMap
{
    /// The place of a set's short form, and whether another area has a set of the same number.
    struct ShortForm
    {
        Location place;
        bool bAmbiguous = false;
    };

    std::unordered_set<Location> _places;
    std::unordered_map<std::string, ShortForm> _shortForms;

public:
    LocationMap() = default;

    /// From lines such as "A01.CP01.TP01-04" (ParseLocationRange). Fails with ECoreError::InvalidLocation, the path names
    /// the line: "[3]".
    [[nodiscard]] static Result<LocationMap> Create(std::span<const std::string> ranges);

    /// No effect for a place that was added before.
    void Add(const Location& location);
    /// Adds each of them.
    void Add(std::span<const Location> locations);

    /// Number of different places.
    [[nodiscard]] std::size_t GetCount() const noexcept;

    /// Whether exactly this place was added, in any spelling; a port does not include the ports inside it.
    [[nodiscard]] bool Contains(const Location& location) const;

    /// A set without its area (SET02, SET02.MP15), completed by the area that has it; nullopt if no or several areas do.
    [[nodiscard]] std::optional<Location> CompleteSetOrNull(const Location& shortForm) const;

    /// The place of a plan's location while this robot executes the plan: AMR.CP01 and LR01.CP01 are the port of LR01, and a
    /// short set is the one in the area of the position (nullptr: unknown), otherwise the only one of the site. Fails with
    /// ECoreError::InvalidLocation for the port of another robot, for an ambiguous set, and for an unknown place. The place
    /// keeps the sender's spelling (GetOriginalText), except for a set completed by the map.
    [[nodiscard]] Result<Location> Resolve(
        const Location& location,
        const RobotID& robotID,
        const Location* positionOrNull = nullptr) const;
};

} // namespace ACS::Core
