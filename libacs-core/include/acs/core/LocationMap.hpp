#pragma once

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

/// The places that a site has, as data: fixed ones and the ports of its robots (section 10). Nothing about a site's size
/// or numbering is built in.
class LocationMap
{
    /// The place that a set's short form stands for, and whether another area has one of the same number.
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

    /// A place that is there already is not added again.
    void Add(const Location& location);
    void Add(std::span<const Location> locations);

    [[nodiscard]] std::size_t GetCount() const noexcept;

    /// Exactly this place, in whatever spelling; a port does not bring along what is inside it.
    [[nodiscard]] bool Contains(const Location& location) const;

    /// A set without its area (SET02, SET02.MP15) with the only area that has it; nullopt where none or several have.
    [[nodiscard]] std::optional<Location> CompleteSetOrNull(const Location& shortForm) const;

    /// The place that a location of a plan means while this robot executes it: AMR.CP01 and LR01.CP01 are the port of
    /// LR01, and a short set is that in the area of the position (nullptr: unknown), else the only one of the site. Fails
    /// with ECoreError::InvalidLocation for the port of another robot, for a set of several areas, and for what the site
    /// does not have. The place keeps the sender's spelling (GetOriginalText), but for a set completed by the map.
    [[nodiscard]] Result<Location> Resolve(
        const Location& location,
        const RobotID& robotID,
        const Location* positionOrNull = nullptr) const;
};

} // namespace ACS::Core
