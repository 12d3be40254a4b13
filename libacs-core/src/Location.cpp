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

constexpr std::size_t KIND_COUNT = static_cast<std::size_t>(ESegmentKind::Robot) + 1;

/// For each kind the bits of those that may follow it.
constexpr std::array<unsigned, KIND_COUNT> MakeFollowers()
{
    std::array<unsigned, KIND_COUNT> followers{};
    for (const Succession& succession : SUCCESSIONS)
    {
        followers[static_cast<std::size_t>(succession.kind)] |= 1U << static_cast<unsigned>(succession.next);
    }
    return followers;
}

constexpr std::array<unsigned, KIND_COUNT> FOLLOWERS = MakeFollowers();

bool CanFollow(ESegmentKind kind, ESegmentKind next)
{
    return (FOLLOWERS[static_cast<std::size_t>(kind)] >> static_cast<unsigned>(next) & 1U) != 0;
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

/// 0 where the digits spell no number of a segment.
std::uint16_t ReadNumber(std::string_view digits)
{
    unsigned number = 0;
    if (digits.size() > MAX_DIGITS)
    {
        return 0;
    }
    for (const char digit : digits)
    {
        if (digit < '0' || digit > '9')
        {
            return 0;
        }
        number = number * 10 + static_cast<unsigned>(digit - '0');
    }
    return static_cast<std::uint16_t>(number);
}

bool TryReadSegment(std::string_view text, LocationSegment& out)
{
    const std::optional<Detail::Element> elementOrNull = Detail::SplitElementOrNull(text);
    if (!elementOrNull.has_value())
    {
        return false;
    }
    out.kind = elementOrNull->kind;
    out.number = ReadNumber(elementOrNull->digits);
    return out.number != 0;
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
bool TryReadRobot(std::string_view text, LocationSegment& out)
{
    out = LocationSegment{ESegmentKind::Robot, 0};
    return RobotID::IsRobotID(text);
}

/// Takes a text apart, in place and without optionals: it runs for every place of every plan.
bool TrySplit(std::string_view text, Parts& parts)
{
    if (text.size() > Location::MAX_LENGTH)
    {
        return false;
    }
    for (std::size_t begin = 0; begin <= text.size();)
    {
        std::size_t end = begin;
        while (end < text.size() && text[end] != '.')
        {
            ++end;
        }
        const std::string_view part = text.substr(begin, end - begin);
        if (parts.count == Location::MAX_SEGMENTS)
        {
            return false;
        }
        LocationSegment& segment = parts.segments[parts.count];
        if (!TryReadSegment(part, segment))
        {
            if (parts.count != 0 || !TryReadRobot(part, segment))
            {
                return false;
            }
            parts.robotName = part;
        }
        ++parts.count;
        begin = end + 1;
    }
    return IsChain(parts.GetSegments());
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

/// Whether the text is a location, and short enough as Print would make it: with a digit more in a segment at most.
bool TryReadLocation(std::string_view text, Parts& parts)
{
    return TrySplit(text, parts)
        && (text.size() + parts.count <= Location::MAX_LENGTH || GetPrintedLength(parts) <= Location::MAX_LENGTH);
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
    Parts parts;
    if (!TryReadLocation(text, parts))
    {
        return Fail(ECoreError::InvalidLocation, {}, std::string(EXPECTED), QuoteForError(text));
    }
    std::optional<RobotID> robotOrNull;
    if (!parts.robotName.empty())
    {
        const bool bAlias = Detail::IsSameWord(parts.robotName, RobotID::ALIAS);
        robotOrNull = RobotID::Parse(bAlias ? RobotID::ALIAS : parts.robotName).value();
    }
    Location location(parts.GetSegments(), std::move(robotOrNull));
    assert(location._text.size() == GetPrintedLength(parts));
    location._originalText = text;
    location._bNormalised = location._originalText != location._text;
    return location;
}

bool Location::IsLocation(std::string_view text) noexcept
{
    Parts parts;
    return TryReadLocation(text, parts);
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
    const std::uint16_t end = ReadNumber(text.substr(dash + 1));
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
