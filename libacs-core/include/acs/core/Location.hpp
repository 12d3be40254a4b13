#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/ESegmentKind.hpp>
#include <acs/core/Result.hpp>
#include <acs/core/RobotID.hpp>

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Core
{

/// One segment of a location: "CP02" is cassette port 2.
struct LocationSegment
{
    ESegmentKind kind = ESegmentKind::Area; ///< According to the letters before the number.
    std::uint16_t number = 0;               ///< 1 to 9999; 0 for a robot.

    bool operator==(const LocationSegment&) const = default;
};

/// A place of MCS-ACS (section 10) such as "A01.CP02.TP01", "ST01", "SET02.MP15", "AMR.CP01" or "LR01.CP01". Valid by
/// construction. Comparing and hashing use the canonical text, so two spellings of one place are equal.
class ACS_API Location
{
public:
    static constexpr std::size_t MAX_LENGTH = 64;     ///< Of the canonical text, in bytes.
    static constexpr std::size_t MAX_SEGMENTS = 4;    ///< A robot counts as one.
    static constexpr std::uint16_t MAX_NUMBER = 9999; ///< Of a segment.

private:
    std::string _text;
    std::string _originalText;
    std::optional<RobotID> _robotOrNull;
    std::array<LocationSegment, MAX_SEGMENTS> _segments{};
    std::size_t _segmentCount = 0;
    bool _bNormalised = false;

    Location(std::span<const LocationSegment> segments, std::optional<RobotID> robotOrNull);

public:
    /// Reads text from outside. Accepts lower case and unpadded numbers (a01.cp1 is A01.CP01; see WasNormalised). A
    /// robot's name keeps its case. Fails with ECoreError::InvalidLocation.
    [[nodiscard]] static Result<Location> Parse(std::string_view text);

    /// Whether Parse would accept this text.
    [[nodiscard]] static bool IsLocation(std::string_view text) noexcept;

    /// Upper case, numbers of two digits or more.
    [[nodiscard]] const std::string& GetText() const noexcept;

    /// The spelling of the sender, for use in reports. WithRobot and WithAreaOf keep it; a docking place has its canonical
    /// text.
    [[nodiscard]] const std::string& GetOriginalText() const noexcept;

    /// Whether the sender's spelling was not canonical.
    [[nodiscard]] bool WasNormalised() const noexcept;

    /// From the outermost to the innermost; never empty.
    [[nodiscard]] std::span<const LocationSegment> GetSegments() const noexcept;

    /// The kind of the innermost segment, and so of the location.
    [[nodiscard]] ESegmentKind GetKind() const noexcept;
    /// Whether the innermost segment is a cassette port (CP).
    [[nodiscard]] bool IsCassettePort() const noexcept;
    /// Whether the innermost segment is a tray port (TP).
    [[nodiscard]] bool IsTrayPort() const noexcept;
    /// Whether the innermost segment is a memory port (MP).
    [[nodiscard]] bool IsMemoryPort() const noexcept;

    /// Whether this is a port on a robot, not a fixed place.
    [[nodiscard]] bool IsRobotPort() const noexcept;

    /// The robot or the alias (RobotID::IsAlias) of a robot port; nullopt for a fixed place.
    [[nodiscard]] const std::optional<RobotID>& GetRobotOrNull() const noexcept;

    /// Whether it begins with an area (A01…).
    [[nodiscard]] bool HasArea() const noexcept;

    /// The number of the area; nullopt without an area.
    [[nodiscard]] std::optional<std::uint16_t> GetAreaNumberOrNull() const noexcept;

    /// Where a robot docks to reach this fixed place: without the trailing tray and memory ports (A01.CP01.TP01 is
    /// reached from A01.CP01, A01.SET01.MP01 from A01.SET01). A robot port is returned as it is.
    [[nodiscard]] Location GetDockingPlace() const;

    /// This location with the alias replaced by the robot (AMR.CP01 becomes LR01.CP01). A fixed place and a port that
    /// already names a robot are returned unchanged. Fails with ECoreError::InvalidLocation if the result would be longer
    /// than MAX_LENGTH.
    [[nodiscard]] Result<Location> WithRobot(const RobotID& robotID) const;

    /// The short form of a set completed by the area of another location (SET02.MP15 with A01.CP01 becomes
    /// A01.SET02.MP15). Returned unchanged if it is not a short form or the other location has no area.
    [[nodiscard]] Location WithAreaOf(const Location& other) const;

    friend bool operator==(const Location& left, const Location& right) noexcept
    {
        return left._text == right._text;
    }

    friend std::strong_ordering operator<=>(const Location& left, const Location& right) noexcept
    {
        return left._text <=> right._text;
    }
};

/// Reads a location or a range over its last number, as the configuration writes them: "A01.CP01.TP01-04" is TP01, TP02,
/// TP03 and TP04 of A01.CP01. Between 1 and 999 locations, in ascending order. Fails with ECoreError::InvalidLocation.
[[nodiscard]] ACS_API Result<std::vector<Location>> ParseLocationRange(std::string_view text);

} // namespace ACS::Core

template <>
struct std::hash<ACS::Core::Location>
{
    std::size_t operator()(const ACS::Core::Location& location) const noexcept
    {
        return std::hash<std::string>()(location.GetText());
    }
};
