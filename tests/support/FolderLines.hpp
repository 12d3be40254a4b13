#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace ACS::Testing
{

/// The names of the files in the folder, sorted.
[[nodiscard]] inline std::vector<std::string> ListNames(const std::filesystem::path& folder)
{
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
    {
        names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
}

/// The lines of all these files.
[[nodiscard]] inline std::vector<std::string> ReadLines(const std::filesystem::path& folder)
{
    std::vector<std::string> lines;
    for (const std::string& name : ListNames(folder))
    {
        std::ifstream file(folder / name);
        for (std::string line; std::getline(file, line);)
        {
            lines.push_back(line);
        }
    }
    return lines;
}

} // namespace ACS::Testing
