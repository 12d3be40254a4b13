#include "Element.hpp"
#include <acs/core/Location.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <utility>

namespace ACS::Core
{

namespace
{

constexpr std::size_t MAX_DIGITS = 4;
constexpr std::size_t MAX_RANGE = 999;
constexpr std::string_view EXPECTED = "a location such as A01.CP01.TP01, A01.SET01 or AMR.CP01";

/// Which segment may follow which (section 10). What is no first kind of any row ends a location.
struct Succession
{
    ESegmentKind kind;
    ESegmentKind next;
};

constexpr std::array<Succession, 9> SUCCESSIONS{{
    {ESegmentKind::Stocker, ESegmentKind::CassettePort},
    {ESegmentKind::Area, ESegmentKind::CassettePort},
    {ESegmentKind::Area, ESegmentKind::Set},
    {ESegmentKind::Area, ESegmentKind::Table},
    {ESegmentKind::Set, ESegmentKind::MemoryPort},
    {ESegmentKind::CassettePort, ESegmentKind::TrayPort},
    {ESegmentKind::TrayPort, ESegmentKind::MemoryPort},
    {ESegmentKind::Robot, ESegmentKind::CassettePort},
    {ESegmentKind::Robot, ESegmentKind::TrayPort},
}};

bool CanFollow(ESegmentKind kind, ESegmentKind next)
{
    return std::ranges::any_of(SUCCESSIONS, [kind, next](const Succession& succession) {
        return succession.kind == kind && succession.next == next;
    });
}

bool CanBegin(ESegmentKind kind)
{
    return kind == ESegmentKind::Stocker || kind == ESegmentKind::Area || kind == ESegmentKind::Set
        || kind == ESegmentKind::Robot;
}

/// Whether the segments, each a kind with a valid number, make a location.
bool IsChain(std::span<const LocationSegment> segments)
{
    if (segments.empty() || !CanBegin(segments.front().kind))
    {
        return false;
    }
    for (std::size_t i = 1; i < segments.size(); ++i)
    {
        if (!CanFollow(segments[i - 1].kind, segments[i].kind))
        {
            return false;
        }
    }
    const bool bRobot = segments.front().kind == ESegmentKind::Robot;
    // A robot alone is no place, and its cassette ports have no tray ports of their own.
    return !bRobot || segments.size() == 2 || (segments.size() == 3 && segments[1].kind == ESegmentKind::TrayPort);
}

std::optional<std::uint16_t> ReadNumberOrNull(std::string_view digits)
{
    std::uint16_t number = 0;
    if (digits.size() > MAX_DIGITS)
    {
        return std::nullopt;
    }
    for (const char digit : digits)
    {
        if (digit < '0' || digit > '9')
        {
            return std::nullopt;
        }
        number = static_cast<std::uint16_t>(number * 10 + (digit - '0'));
    }
    return number == 0 ? std::nullopt : std::optional(number);
}

std::optional<LocationSegment> ReadSegmentOrNull(std::string_view text)
{
    const std::optional<Detail::Element> elementOrNull = Detail::SplitElementOrNull(text);
    const std::optional<std::uint16_t> numberOrNull =
        elementOrNull.has_value() ? ReadNumberOrNull(elementOrNull->digits) : std::nullopt;
    if (!numberOrNull.has_value())
    {
        return std::nullopt;
    }
    return LocationSegment{elementOrNull->kind, *numberOrNull};
}

/// A text taken apart: valid segments in a valid order.
struct Parts
{
    std::array<LocationSegment, Location::MAX_SEGMENTS> segments{};
    std::size_t count = 0;
    std::string_view robotName; ///< Of a robot port, as the sender spelled it.

    [[nodiscard]] std::span<const LocationSegment> GetSegments() const
    {
        return std::span(segments).first(count);
    }
};

/// What the first segment names where it is no element: a robot or nothing.
std::optional<LocationSegment> ReadRobotOrNull(std::string_view text)
{
    return RobotID::IsRobotID(text) ? std::optional(LocationSegment{ESegmentKind::Robot, 0}) : std::nullopt;
}

std::optional<Parts> SplitOrNull(std::string_view text)
{
    Parts parts;
    if (text.size() > Location::MAX_LENGTH)
    {
        return std::nullopt;
    }
    for (std::size_t begin = 0; begin <= text.size();)
    {
        const std::size_t end = std::min(text.find('.', begin), text.size());
        const std::string_view part = text.substr(begin, end - begin);
        std::optional<LocationSegment> segmentOrNull = ReadSegmentOrNull(part);
        if (parts.count == 0 && !segmentOrNull.has_value())
        {
            segmentOrNull = ReadRobotOrNull(part);
            parts.robotName = part;
        }
        if (!segmentOrNull.has_value() || parts.count == Location::MAX_SEGMENTS)
        {
            return std::nullopt;
        }
        parts.segments[parts.count] = *segmentOrNull;
        ++parts.count;
        begin = end + 1;
    }
    return IsChain(parts.GetSegments()) ? std::optional(parts) : std::nullopt;
}

/// Of what Print would make.
std::size_t GetPrintedLength(const Parts& parts)
{
    std::size_t length = parts.count - 1;
    for (const LocationSegment& segment : parts.GetSegments())
    {
        const std::size_t digits = segment.number < 100 ? 2 : segment.number < 1000 ? 3 : 4;
        length += segment.kind == ESegmentKind::Robot ? parts.robotName.size()
                                                      : Detail::GetPrefix(segment.kind).size() + digits;
    }
    return length;
}

std::string Print(std::span<const LocationSegment> segments, const std::optional<RobotID>& robotOrNull)
{
    std::string text;
    for (const LocationSegment& segment : segments)
    {
        if (!text.empty())
        {
            text += '.';
        }
        if (segment.kind == ESegmentKind::Robot && robotOrNull.has_value())
        {
            text += robotOrNull->GetText();
        }
        else
        {
            fmt::format_to(std::back_inserter(text), "{}{:02}", Detail::GetPrefix(segment.kind), segment.number);
        }
    }
    return text;
}

} // namespace

Location::Location(std::span<const LocationSegment> segments, std::optional<RobotID> robotOrNull)
    : _text(Print(segments, robotOrNull)),
      _originalText(_text),
      _robotOrNull(std::move(robotOrNull)),
      _segmentCount(segments.size())
{
    std::ranges::copy(segments, _segments.begin());
}

Result<Location> Location::Parse(std::string_view text)
{
    const std::optional<Parts> partsOrNull = SplitOrNull(text);
    if (!partsOrNull.has_value() || GetPrintedLength(*partsOrNull) > MAX_LENGTH)
    {
        return Fail(ECoreError::InvalidLocation, {}, std::string(EXPECTED), QuoteForError(text));
    }
    std::optional<RobotID> robotOrNull;
    if (!partsOrNull->robotName.empty())
    {
        const bool bAlias = Detail::IsSameWord(partsOrNull->robotName, RobotID::ALIAS);
        robotOrNull = RobotID::Parse(bAlias ? RobotID::ALIAS : partsOrNull->robotName).value();
    }
    Location location(partsOrNull->GetSegments(), std::move(robotOrNull));
    assert(location._text.size() == GetPrintedLength(*partsOrNull));
    location._originalText = text;
    location._bNormalised = location._originalText != location._text;
    return location;
}

bool Location::IsLocation(std::string_view text) noexcept
{
    const std::optional<Parts> partsOrNull = SplitOrNull(text);
    return partsOrNull.has_value() && GetPrintedLength(*partsOrNull) <= MAX_LENGTH;
}

const std::string& Location::GetText() const noexcept
{
    return _text;
}

const std::string& Location::GetOriginalText() const noexcept
{
    return _originalText;
}

bool Location::WasNormalised() const noexcept
{
    return _bNormalised;
}

std::span<const LocationSegment> Location::GetSegments() const noexcept
{
    return std::span(_segments).first(_segmentCount);
}

ESegmentKind Location::GetKind() const noexcept
{
    return GetSegments().back().kind;
}

bool Location::IsCassettePort() const noexcept
{
    return GetKind() == ESegmentKind::CassettePort;
}

bool Location::IsTrayPort() const noexcept
{
    return GetKind() == ESegmentKind::TrayPort;
}

bool Location::IsMemoryPort() const noexcept
{
    return GetKind() == ESegmentKind::MemoryPort;
}

bool Location::IsRobotPort() const noexcept
{
    return _robotOrNull.has_value();
}

const std::optional<RobotID>& Location::GetRobotOrNull() const noexcept
{
    return _robotOrNull;
}

bool Location::HasArea() const noexcept
{
    return _segments.front().kind == ESegmentKind::Area;
}

std::optional<std::uint16_t> Location::GetAreaNumberOrNull() const noexcept
{
    return HasArea() ? std::optional(_segments.front().number) : std::nullopt;
}

Location Location::GetDockingPlace() const
{
    std::span<const LocationSegment> segments = GetSegments();
    if (IsRobotPort())
    {
        return *this;
    }
    while (segments.back().kind == ESegmentKind::TrayPort || segments.back().kind == ESegmentKind::MemoryPort)
    {
        segments = segments.first(segments.size() - 1);
    }
    return Location(segments, std::nullopt);
}

Result<Location> Location::WithRobot(const RobotID& robotID) const
{
    if (!IsRobotPort() || !_robotOrNull->IsAlias())
    {
        return *this;
    }
    Location location(GetSegments(), robotID);
    if (location._text.size() > MAX_LENGTH)
    {
        return Fail(
            ECoreError::InvalidLocation,
            {},
            "a robot's name that leaves room for its ports",
            robotID.GetText());
    }
    location._originalText = _originalText;
    location._bNormalised = _bNormalised;
    return location;
}

Location Location::WithAreaOf(const Location& other) const
{
    if (_segments.front().kind != ESegmentKind::Set || !other.HasArea())
    {
        return *this;
    }
    std::array<LocationSegment, MAX_SEGMENTS> segments{other._segments.front()};
    std::ranges::copy(GetSegments(), segments.begin() + 1);
    const std::span<const LocationSegment> used = std::span(segments).first(_segmentCount + 1);
    Location location(used, std::nullopt);
    location._originalText = _originalText;
    location._bNormalised = _bNormalised;
    return location;
}

Result<std::vector<Location>> ParseLocationRange(std::string_view text)
{
    const std::size_t dot = text.rfind('.');
    const std::size_t dash = text.find('-', dot == std::string_view::npos ? 0 : dot);
    Result<Location> first = Location::Parse(text.substr(0, dash));
    if (!first.has_value())
    {
        return tl::unexpected(first.error());
    }
    if (dash == std::string_view::npos)
    {
        return std::vector<Location>{std::move(*first)};
    }
    const std::uint16_t begin = first->GetSegments().back().number;
    const std::uint16_t end = ReadNumberOrNull(text.substr(dash + 1)).value_or(0);
    if (end < begin || end - begin >= static_cast<int>(MAX_RANGE))
    {
        return Fail(
            ECoreError::InvalidLocation,
            {},
            "a range of at most 999 such as A01.CP01.TP01-04",
            QuoteForError(text));
    }
    const std::string& canonical = first->GetText();
    const std::string stem = canonical.substr(0, canonical.find_last_not_of("0123456789") + 1);
    std::vector<Location> locations;
    locations.reserve(end - begin + 1U);
    for (unsigned number = begin; number <= end; ++number)
    {
        Result<Location> location = Location::Parse(fmt::format("{}{:02}", stem, number));
        if (!location.has_value())
        {
            return tl::unexpected(location.error());
        }
        locations.push_back(std::move(*location));
    }
    return locations;
}

} // namespace ACS::Core
