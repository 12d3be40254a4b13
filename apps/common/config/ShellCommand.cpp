#include "common/config/ShellCommand.hpp"

#include <algorithm>

namespace ACS::Apps
{

namespace
{

constexpr std::string_view PLAIN_SIGNS = "-._:@%+/,";

} // namespace

std::string QuoteForShell(std::string_view word)
{
    const bool bPlain = std::all_of(word.begin(), word.end(), [](char letter) {
        const bool bLetter = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z');
        return bLetter || (letter >= '0' && letter <= '9') || PLAIN_SIGNS.find(letter) != std::string_view::npos;
    });
    if (bPlain && !word.empty())
    {
        return std::string(word);
    }
    std::string quoted = "'";
    for (const char letter : word)
    {
        if (letter == '\'')
        {
            quoted += R"('\'')";
        }
        else
        {
            quoted += letter;
        }
    }
    return quoted + "'";
}

std::string MakeShellCommand(std::string_view command, const std::vector<std::string>& words)
{
    std::string line = "acsctl ";
    line += command;
    const bool bDash =
        std::any_of(words.begin(), words.end(), [](const std::string& word) { return word.starts_with('-'); });
    line += bDash ? " --" : "";
    for (const std::string& word : words)
    {
        line.append(" ").append(QuoteForShell(word));
    }
    return line;
}

} // namespace ACS::Apps
