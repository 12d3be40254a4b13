#include "robots/ArmRelay.hpp"

#include <acs/core/ParseNumber.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <tuple>
#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr std::uint32_t BITS_PER_BYTE = 8;
constexpr std::uint32_t BYTE_MASK = 0xFF;
constexpr std::uint32_t WORD_BYTES = 4; ///< Size of one number of val_s32.
/// Size of the areas m and s.
constexpr std::uint32_t MEMORY_BYTES = 20'000;
/// Size of the areas r and k, and of each block or node of a fieldbus.
constexpr std::uint32_t BLOCK_BYTES = 128;
constexpr std::uint32_t FIELDBUS_BLOCKS = 10;
constexpr std::uint32_t FIELDBUS_NODES = 64;
/// A longer gap between relays is not read; it separates two ranges.
constexpr std::uint32_t LONGEST_GAP = 64;

constexpr std::array<std::string_view, 8> AREAS{"di", "do", "x", "y", "m", "s", "r", "k"};
constexpr std::string_view DIGITS = "0123456789";

std::uint32_t GetBytes(EArmRelayWidth width)
{
    switch (width)
    {
        case EArmRelayWidth::Word:
            return 2;
        case EArmRelayWidth::Long:
            return WORD_BYTES;
        case EArmRelayWidth::Bit:
        case EArmRelayWidth::Byte:
        default:
            return 1;
    }
}

std::uint32_t GetAreaBytes(std::string_view area, bool bFieldbus)
{
    if (bFieldbus || area == "r" || area == "k")
    {
        return BLOCK_BYTES;
    }
    return area == "m" || area == "s" ? MEMORY_BYTES : BLOCK_BYTES * FIELDBUS_BLOCKS;
}

std::uint32_t GetBits(EArmRelayWidth width)
{
    return width == EArmRelayWidth::Bit ? 1 : GetBytes(width) * BITS_PER_BYTE;
}

struct ValueRange
{
    std::int64_t lowest;
    std::int64_t highest;
};

/// Values of bytes and words may be signed or unsigned.
ValueRange GetValueRange(EArmRelayWidth width)
{
    if (width == EArmRelayWidth::Bit)
    {
        return {0, 1};
    }
    if (width == EArmRelayWidth::Long)
    {
        return {std::numeric_limits<std::int32_t>::min(), std::numeric_limits<std::int32_t>::max()};
    }
    const std::int64_t values = std::int64_t{1} << GetBits(width);
    return {-values / 2, values - 1};
}

/// Whether the text, "fb0", names a block or node of a fieldbus.
bool IsFieldbus(std::string_view text)
{
    const bool bBlock = text.starts_with("fb");
    if (!bBlock && !text.starts_with("fn"))
    {
        return false;
    }
    const std::optional<std::uint32_t> indexOrNull = Core::ParseNumberOrNull<std::uint32_t>(text.substr(2));
    return indexOrNull.has_value() && *indexOrNull < (bBlock ? FIELDBUS_BLOCKS : FIELDBUS_NODES);
}

/// `text` is the part between the area and the number.
std::optional<EArmRelayWidth> ReadWidthOrNull(std::string_view text)
{
    constexpr std::array WIDTHS{
        std::pair{std::string_view(""), EArmRelayWidth::Bit},
        std::pair{std::string_view("b"), EArmRelayWidth::Byte},
        std::pair{std::string_view("w"), EArmRelayWidth::Word},
        std::pair{std::string_view("l"), EArmRelayWidth::Long}};
    const auto* const found =
        std::find_if(WIDTHS.begin(), WIDTHS.end(), [text](const auto& width) { return width.first == text; });
    return found == WIDTHS.end() ? std::nullopt : std::optional(found->second);
}

} // namespace

tl::expected<ArmRelay, std::string> ParseArmRelay(std::string_view name)
{
    return ParseArmRelay(name, EArmRelayIndex::Value);
}

tl::expected<ArmRelay, std::string> ParseArmRelay(std::string_view name, EArmRelayIndex index)
{
    const auto fail = [name](std::string_view why) {
        return tl::unexpected(fmt::format(
            "{} is not a relay that can be read back: {}. Give [fbN.|fnN.], one of di, do, x, y, m, s, r, k, then nothing, "
            "b, w or l for its width, then its number, as in ml105 or fb0.do3",
            name,
            why));
    };
    const std::size_t dot = name.find('.');
    const std::string_view bus = dot == std::string_view::npos ? std::string_view() : name.substr(0, dot);
    const std::string_view rest = dot == std::string_view::npos ? name : name.substr(dot + 1);
    if (dot != std::string_view::npos && !IsFieldbus(bus))
    {
        return fail("the part before the dot is not fb0 to fb9 or fn0 to fn63");
    }
    const auto* const area =
        std::find_if(AREAS.begin(), AREAS.end(), [rest](std::string_view known) { return rest.starts_with(known); });
    const std::size_t digits = std::min(rest.find_first_of(DIGITS), rest.size());
    if (area == AREAS.end() || digits < area->size())
    {
        return fail("its area is unknown");
    }
    const std::optional<EArmRelayWidth> widthOrNull = ReadWidthOrNull(rest.substr(area->size(), digits - area->size()));
    if (!widthOrNull.has_value())
    {
        return fail("its area or width is unknown");
    }
    const std::optional<std::uint32_t> numberOrNull = Core::ParseNumberOrNull<std::uint32_t>(rest.substr(digits));
    const std::uint32_t width = GetBytes(*widthOrNull);
    const std::uint32_t step = index == EArmRelayIndex::Value ? width : 1;
    const bool bBit = *widthOrNull == EArmRelayWidth::Bit;
    const std::uint32_t bytes = GetAreaBytes(*area, !bus.empty());
    const std::uint32_t count = bBit ? bytes * BITS_PER_BYTE : (bytes - width) / step + 1;
    if (!numberOrNull.has_value() || *numberOrNull >= count)
    {
        return fail(fmt::format("its number is not one of 0 to {}", count - 1));
    }
    ArmRelay relay;
    relay.name = name;
    relay.url = fmt::format("/project/plc/{}{}{}/val_s32", bus, bus.empty() ? "" : "_", *area);
    relay.width = *widthOrNull;
    relay.firstByte = bBit ? *numberOrNull / BITS_PER_BYTE : *numberOrNull * step;
    relay.bit = bBit ? static_cast<std::uint8_t>(*numberOrNull % BITS_PER_BYTE) : std::uint8_t{0};
    return relay;
}

bool CanHold(const ArmRelay& relay, std::int64_t value) noexcept
{
    const ValueRange range = GetValueRange(relay.width);
    return value >= range.lowest && value <= range.highest;
}

std::string MakeRangeText(const ArmRelay& relay)
{
    const ValueRange range = GetValueRange(relay.width);
    return fmt::format("{} to {}", range.lowest, range.highest);
}

bool IsOverlapping(const ArmRelay& left, const ArmRelay& right) noexcept
{
    const std::uint32_t leftBit = left.firstByte * BITS_PER_BYTE + left.bit;
    const std::uint32_t rightBit = right.firstByte * BITS_PER_BYTE + right.bit;
    return left.url == right.url && leftBit < rightBit + GetBits(right.width)
        && rightBit < leftBit + GetBits(left.width);
}

std::vector<ArmRelayRange> MakeRelayRanges(const std::vector<ArmRelay>& relays)
{
    std::vector<ArmRelay> sorted = relays;
    std::sort(sorted.begin(), sorted.end(), [](const ArmRelay& left, const ArmRelay& right) {
        return std::tie(left.url, left.firstByte) < std::tie(right.url, right.firstByte);
    });
    std::vector<ArmRelayRange> ranges;
    for (const ArmRelay& relay : sorted)
    {
        const std::uint32_t first = relay.firstByte - relay.firstByte % WORD_BYTES;
        const std::uint32_t end = ranges.empty() ? 0 : ranges.back().firstByte + ranges.back().words * WORD_BYTES;
        if (ranges.empty() || ranges.back().url != relay.url || first > end + LONGEST_GAP)
        {
            ranges.push_back({relay.url, first, 1});
        }
        ArmRelayRange& range = ranges.back();
        const std::uint32_t last = relay.firstByte + GetBytes(relay.width) - 1;
        range.words = std::max(range.words, (last - range.firstByte) / WORD_BYTES + 1);
    }
    return ranges;
}

std::optional<std::int32_t> ReadRelayOrNull(
    const ArmRelay& relay,
    const ArmRelayRange& range,
    const std::vector<std::int64_t>& words)
{
    const std::uint32_t bytes = GetBytes(relay.width);
    if (relay.url != range.url || relay.firstByte < range.firstByte
        || relay.firstByte - range.firstByte + bytes > words.size() * WORD_BYTES)
    {
        return std::nullopt;
    }
    std::uint32_t value = 0; // a relay may lie in two words
    for (std::uint32_t i = 0; i < bytes; ++i)
    {
        const std::uint32_t offset = relay.firstByte - range.firstByte + i;
        const auto word = static_cast<std::uint32_t>(words[offset / WORD_BYTES]);
        value |= (word >> (offset % WORD_BYTES * BITS_PER_BYTE) & BYTE_MASK) << (i * BITS_PER_BYTE);
    }
    switch (relay.width)
    {
        case EArmRelayWidth::Bit:
            return static_cast<std::int32_t>(value >> relay.bit & 1U);
        case EArmRelayWidth::Byte:
            return static_cast<std::int8_t>(value);
        case EArmRelayWidth::Word:
            return static_cast<std::int16_t>(value);
        case EArmRelayWidth::Long:
        default:
            return static_cast<std::int32_t>(value);
    }
}

bool IsSameValue(const ArmRelay& relay, std::int32_t written, std::int32_t read) noexcept
{
    const std::uint32_t difference = static_cast<std::uint32_t>(written) ^ static_cast<std::uint32_t>(read);
    const std::uint32_t mask =
        relay.width == EArmRelayWidth::Long ? ~std::uint32_t{0} : (std::uint32_t{1} << GetBits(relay.width)) - 1;
    return (difference & mask) == 0;
}

} // namespace ACS::Acsd
