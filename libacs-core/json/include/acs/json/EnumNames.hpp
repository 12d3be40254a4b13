#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cctype>
#include <cstddef>
#include <string>
#include <string_view>

namespace ACS::Json
{

template <typename TEnum>
struct EnumWord
{
    TEnum value;
    std::string_view text;
};

/// The words of an enumeration on the wire; specialise once per enumeration:
/// `template <> struct EnumNames<EResult> { static constexpr std::array WORDS{EnumWord{EResult::Success, "Success"}, …}; };`
template <typename TEnum>
struct EnumNames;

template <typename TEnum>
concept WordedEnum = requires
{
    EnumNames<TEnum>::WORDS;
};

template <WordedEnum TEnum>
[[nodiscard]] constexpr std::string_view GetWord(TEnum value)
{
    for (const EnumWord<TEnum>& word : EnumNames<TEnum>::WORDS)
    {
        if (word.value == value)
        {
            return word.text;
        }
    }
    assert(false && "an enumerator has no word");
    return {};
}

[[nodiscard]] inline bool IsEqualIgnoringCase(std::string_view left, std::string_view right)
{
    const auto isSame = [](char one, char other) {
        return std::tolower(static_cast<unsigned char>(one)) == std::tolower(static_cast<unsigned char>(other));
    };
    return left.size() == right.size() && std::equal(left.begin(), left.end(), right.begin(), isSame);
}

/// Reads a word exactly, else (bExactOut false) ignoring case; false where there is no such word.
template <WordedEnum TEnum>
[[nodiscard]] bool TryReadWord(std::string_view text, TEnum& valueOut, bool& bExactOut)
{
    for (const EnumWord<TEnum>& word : EnumNames<TEnum>::WORDS)
    {
        if (word.text == text)
        {
            valueOut = word.value;
            bExactOut = true;
            return true;
        }
    }
    for (const EnumWord<TEnum>& word : EnumNames<TEnum>::WORDS)
    {
        if (IsEqualIgnoringCase(word.text, text))
        {
            valueOut = word.value;
            bExactOut = false;
            return true;
        }
    }
    return false;
}

/// "one of Auto, Paused, Pausing"
template <WordedEnum TEnum>
[[nodiscard]] std::string ListWords()
{
    std::string list = "one of ";
    for (const EnumWord<TEnum>& word : EnumNames<TEnum>::WORDS)
    {
        list += list.size() == std::string_view("one of ").size() ? "" : ", ";
        list += word.text;
    }
    return list;
}

} // namespace ACS::Json
