#include "Element.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace ACS::Core::Detail
{

namespace
{

constexpr std::size_t LONGEST_PREFIX = 3;

/// Up to LONGEST_PREFIX letters as one number, to be compared at once. Begins with NO_LETTERS, so that their count counts.
using PackedLetters = std::uint32_t;
constexpr PackedLetters NO_LETTERS = 1;

constexpr PackedLetters AddLetter(PackedLetters letters, char letter)
{
    return letters << 8U | static_cast<unsigned char>(letter);
}

struct Prefix
{
    ESegmentKind kind;
    std::string_view text;
    PackedLetters letters;

    constexpr Prefix(ESegmentKind prefixKind, std::string_view prefixText)
        : kind(prefixKind),
          text(prefixText),
          letters(std::accumulate(prefixText.begin(), prefixText.end(), NO_LETTERS, AddLetter))
    {
    }
};

constexpr std::array<Prefix, 7> PREFIXES{
    Prefix{ESegmentKind::Stocker, "ST"},
    Prefix{ESegmentKind::Area, "A"},
    Prefix{ESegmentKind::Table, "T"},
    Prefix{ESegmentKind::Set, "SET"},
    Prefix{ESegmentKind::CassettePort, "CP"},
    Prefix{ESegmentKind::TrayPort, "TP"},
    Prefix{ESegmentKind::MemoryPort, "MP"},
};

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
    PackedLetters letters = NO_LETTERS;
    std::size_t firstDigit = 0;
    while (firstDigit < text.size() && firstDigit <= LONGEST_PREFIX && !IsDigit(text[firstDigit]))
    {
        letters = AddLetter(letters, ToUpper(text[firstDigit]));
        ++firstDigit;
    }
    if (firstDigit > LONGEST_PREFIX || firstDigit == text.size())
    {
        return std::nullopt;
    }
    for (std::size_t position = firstDigit + 1; position < text.size(); ++position)
    {
        if (!IsDigit(text[position]))
        {
            return std::nullopt;
        }
    }
    const auto* const found = std::ranges::find(PREFIXES, letters, &Prefix::letters);
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
