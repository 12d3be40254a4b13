#pragma once

#include <string_view>

namespace ACS::Apps
{

/// Removes the next word, without leading blanks, from the front of the text; empty if there is none.
[[nodiscard]] inline std::string_view TakeWord(std::string_view& text)
{
    constexpr std::string_view BLANKS = " \t\r";
    const std::size_t begin = text.find_first_not_of(BLANKS);
    if (begin == std::string_view::npos)
    {
        text = {};
        return {};
    }
    text.remove_prefix(begin);
    const std::string_view word = text.substr(0, text.find_first_of(BLANKS));
    text.remove_prefix(word.size());
    return word;
}

/// Whether the wanted word is one of the words.
[[nodiscard]] inline bool ContainsWord(std::string_view words, std::string_view wanted)
{
    while (!words.empty())
    {
        if (TakeWord(words) == wanted)
        {
            return true;
        }
    }
    return false;
}

} // namespace ACS::Apps
