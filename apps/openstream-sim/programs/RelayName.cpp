#include "programs/RelayName.hpp"

#include <acs/core/ParseNumber.hpp>

#include <array>
#include <string>
#include <utility>

namespace ACS::OpenStreamSim
{

namespace
{

constexpr std::size_t FIELDBUS_BLOCKS = 10;
constexpr std::size_t FIELDBUS_NODES = 64;

/// The longer names first: "si3" is not a relay of area s.
constexpr std::array AREAS{
    std::pair{std::string_view("di"), ERelayArea::Di},
    std::pair{std::string_view("do"), ERelayArea::Do},
    std::pair{std::string_view("si"), ERelayArea::Si},
    std::pair{std::string_view("so"), ERelayArea::So},
    std::pair{std::string_view("x"), ERelayArea::X},
    std::pair{std::string_view("y"), ERelayArea::Y},
    std::pair{std::string_view("m"), ERelayArea::M},
    std::pair{std::string_view("s"), ERelayArea::S},
    std::pair{std::string_view("r"), ERelayArea::R},
    std::pair{std::string_view("k"), ERelayArea::K}};

constexpr std::array WIDTHS{
    std::pair{'b', ERelayWidth::Byte},
    std::pair{'w', ERelayWidth::Word},
    std::pair{'l', ERelayWidth::Long},
    std::pair{'f', ERelayWidth::Float}};

std::string ToLowerCase(std::string_view text)
{
    std::string result(text);
    for (char& letter : result)
    {
        letter = letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
    }
    return result;
}

/// Removes the prefix "fb0." or "fn12_" from the text; false if there is an invalid one.
bool TryTakeBus(char separator, std::string_view& text, RelayBlock& block)
{
    if (!text.starts_with("fb") && !text.starts_with("fn"))
    {
        return true;
    }
    const std::size_t end = text.find(separator);
    if (end == std::string_view::npos)
    {
        return false;
    }
    const bool bBlock = text.starts_with("fb");
    const std::optional<std::size_t> index = Core::ParseNumberOrNull<std::size_t>(text.substr(2, end - 2));
    if (!index.has_value() || *index >= (bBlock ? FIELDBUS_BLOCKS : FIELDBUS_NODES))
    {
        return false;
    }
    block.bus = bBlock ? ERelayBus::Fb : ERelayBus::Fn;
    block.index = static_cast<std::uint8_t>(*index);
    text.remove_prefix(end + 1);
    return true;
}

} // namespace

std::size_t GetFirstByte(const RelayName& name) noexcept
{
    return name.width == ERelayWidth::Bit ? name.number / BITS_PER_BYTE : name.number * GetBytes(name.width);
}

bool IsInside(const RelayName& name) noexcept
{
    return name.number < RELAY_BYTES * BITS_PER_BYTE && GetFirstByte(name) + GetBytes(name.width) <= RELAY_BYTES;
}

std::optional<RelayType> ParseRelayTypeOrNull(std::string_view text)
{
    for (const auto& [word, area] : AREAS)
    {
        if (!text.starts_with(word))
        {
            continue;
        }
        const std::string_view rest = text.substr(word.size());
        if (rest.empty())
        {
            return RelayType{area, ERelayWidth::Bit};
        }
        for (const auto& [letter, width] : WIDTHS)
        {
            if (rest.size() == 1 && rest.front() == letter)
            {
                return RelayType{area, width};
            }
        }
    }
    return std::nullopt;
}

std::optional<RelayBlock> ParseRelayBlockOrNull(std::string_view text)
{
    RelayBlock block;
    if (!TryTakeBus('_', text, block))
    {
        return std::nullopt;
    }
    const std::optional<RelayType> type = ParseRelayTypeOrNull(text);
    if (!type.has_value() || type->width != ERelayWidth::Bit || type->area == ERelayArea::Si
        || type->area == ERelayArea::So)
    {
        return std::nullopt;
    }
    block.area = type->area;
    return block;
}

std::optional<RelayName> ParseRelayNameOrNull(std::string_view anyCase)
{
    const std::string lowerCase = ToLowerCase(anyCase);
    std::string_view text = lowerCase;
    RelayName name;
    if (!TryTakeBus('.', text, name.block))
    {
        return std::nullopt;
    }
    const std::size_t digits = text.find_first_of("0123456789");
    if (digits == std::string_view::npos)
    {
        return std::nullopt;
    }
    const std::optional<RelayType> type = ParseRelayTypeOrNull(text.substr(0, digits));
    const std::optional<std::size_t> number = Core::ParseNumberOrNull<std::size_t>(text.substr(digits));
    if (!type.has_value() || !number.has_value())
    {
        return std::nullopt;
    }
    const bool bSystem = type->area == ERelayArea::Si || type->area == ERelayArea::So;
    if (bSystem && name.block.bus != ERelayBus::None)
    {
        return std::nullopt;
    }
    name.block.area = type->area;
    name.width = type->width;
    name.number = *number;
    return IsInside(name) ? std::optional(name) : std::nullopt;
}

} // namespace ACS::OpenStreamSim
