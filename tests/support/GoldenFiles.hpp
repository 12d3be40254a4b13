#pragma once

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>

namespace ACS::Testing
{

/// A golden file: one line, without its line end. Throws if the file or the line end is missing.
inline std::string ReadGolden(const std::filesystem::path& folder, const std::string& name)
{
    std::ifstream file(folder / name, std::ios::binary);
    std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    if (text.empty() || text.back() != '\n')
    {
        throw std::runtime_error("no golden file " + name);
    }
    text.pop_back();
    return text;
}

inline std::set<std::string> ListGolden(const std::filesystem::path& folder)
{
    std::set<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
    {
        names.insert(entry.path().filename().string());
    }
    return names;
}

/// The same text without the members that are null.
inline std::string DropNullMembers(const std::string& text)
{
    static const std::regex NULL_MEMBER(R"RE("[A-Za-z0-9.]+":null,?)RE");
    static const std::regex LAST_COMMA(R"RE(,\})RE");
    return std::regex_replace(std::regex_replace(text, NULL_MEMBER, ""), LAST_COMMA, "}");
}

} // namespace ACS::Testing
