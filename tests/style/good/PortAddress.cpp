#include "PortAddress.hpp"

#include "ESampleError.hpp"

#include <algorithm>
#include <charconv>
#include <utility>

namespace ACS::Sample
{

namespace
{

constexpr std::size_t PREFIX_LENGTH = 2;

std::optional<EPortKind> GetKindOrNull(std::string_view prefix)
{
    if (prefix == "CP")
    {
        return EPortKind::Cassette;
    }
    if (prefix == "TP")
    {
        return EPortKind::Tray;
    }
    if (prefix == "MP")
    {
        return EPortKind::Memory;
    }
    return std::nullopt;
}

std::optional<PortSegment> ParseSegmentOrNull(std::string_view text)
{
    const std::optional<EPortKind> kindOrNull = GetKindOrNull(text.substr(0, PREFIX_LENGTH));
    if (!kindOrNull.has_value())
    {
        return std::nullopt;
    }

    PortSegment segment;
    segment.kind = *kindOrNull;
    const std::string_view digits = text.substr(PREFIX_LENGTH);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), segment.number);
    const bool bConsumedAll = end == digits.data() + digits.size();
    if (error != std::errc() || !bConsumedAll)
    {
        return std::nullopt;
    }
    return segment;
}

} // namespace

PortAddress::PortAddress(std::string ownerID, std::vector<PortSegment> segments)
    : _ownerID(std::move(ownerID)),
      _segments(std::move(segments))
{
}

std::variant<PortAddress, std::error_code> PortAddress::Parse(std::string_view text)
{
    const std::size_t ownerEnd = std::min(text.find('.'), text.size());
    std::string ownerID(text.substr(0, ownerEnd));
    std::vector<PortSegment> segments;
    std::string_view rest = text.substr(ownerEnd);
    while (!rest.empty() && segments.size() < MAX_SEGMENTS)
    {
        rest.remove_prefix(1);
        const std::size_t segmentEnd = std::min(rest.find('.'), rest.size());
        const std::optional<PortSegment> segmentOrNull = ParseSegmentOrNull(rest.substr(0, segmentEnd));
        if (!segmentOrNull.has_value())
        {
            return make_error_code(ESampleError::Malformed);
        }
        segments.push_back(*segmentOrNull);
        rest.remove_prefix(segmentEnd);
    }

    if (ownerID.empty() || !rest.empty())
    {
        return make_error_code(ESampleError::Malformed);
    }
    return PortAddress(std::move(ownerID), std::move(segments));
}

const std::string& PortAddress::GetOwnerID() const noexcept
{
    return _ownerID;
}

bool PortAddress::HasPort() const noexcept
{
    return !_segments.empty();
}

std::optional<std::uint32_t> PortAddress::GetPortNumberOrNull(EPortKind kind) const
{
    const PortSegment* segmentOrNull = FindSegmentOrNull(kind);
    if (segmentOrNull == nullptr)
    {
        return std::nullopt;
    }
    return segmentOrNull->number;
}

const PortSegment* PortAddress::FindSegmentOrNull(EPortKind kind) const
{
    const auto found = std::ranges::find(_segments, kind, &PortSegment::kind);
    return found == _segments.end() ? nullptr : &*found;
}

} // namespace ACS::Sample
