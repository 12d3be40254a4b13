#include "Element.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace ACS::Core::Detail
{

namespace
{

struct Prefix
{
    ESegmentKind kind;
    std::string_view text;
};

constexpr std::array<Prefix, 7> PREFIXES{{
    {ESegmentKind::Stocker, "ST"},
    {ESegmentKind::Area, "A"},
    {ESegmentKind::Table, "T"},
    {ESegmentKind::Set, "SET"},
    {ESegmentKind::CassettePort, "CP"},
    {ESegmentKind::TrayPort, "TP"},
    {ESegmentKind::MemoryPort, "MP"},
}};

constexpr std::size_t LONGEST_PREFIX = 3;

bool IsDigit(char character)
{
    return character >= '0' && character <= '9';
}

char ToUpper(char character)
{
    return character >= 'a' && character <= 'z' ? static_cast<char>(character - 'a' + 'A') : character;
}

} // namespace

std::optional<Element> SplitElementOrNull(std::string_view text)
{
    std::size_t firstDigit = 0;
    while (firstDigit < text.size() && firstDigit <= LONGEST_PREFIX && !IsDigit(text[firstDigit]))
    {
        ++firstDigit;
    }
    if (firstDigit > LONGEST_PREFIX || firstDigit == text.size()
        || !std::all_of(text.begin() + static_cast<std::ptrdiff_t>(firstDigit), text.end(), IsDigit))
    {
        return std::nullopt;
    }
    const auto* const found = std::ranges::find_if(PREFIXES, [text, firstDigit](const Prefix& prefix) {
        return IsSameWord(text.substr(0, firstDigit), prefix.text);
    });
    if (found == PREFIXES.end())
    {
        return std::nullopt;
    }
    return Element{found->kind, text.substr(firstDigit)};
}

std::string_view GetPrefix(ESegmentKind kind)
{
    const auto* const found = std::ranges::find(PREFIXES, kind, &Prefix::kind);
    return found == PREFIXES.end() ? std::string_view() : found->text;
}

bool IsSameWord(std::string_view text, std::string_view upperWord)
{
    return text.size() == upperWord.size() && std::ranges::equal(text, upperWord, {}, ToUpper);
}

} // namespace ACS::Core::Detail
