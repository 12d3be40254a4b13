#pragma once

#include "common/config/ConfigSection.hpp"

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Apps
{

/// Reads a TOML file and the overrides of the command line. All errors are collected instead of stopping at the first one:
/// read all keys from the sections, then check GetErrors(). A key that was not read is an error too.
class ConfigReader final
{
    std::shared_ptr<ConfigDocument> _document;

    explicit ConfigReader(std::shared_ptr<ConfigDocument> document);

public:
    /// A regular file of at most 4 MiB. Overrides: "table.key=value". A value that is not TOML is a string; the last override
    /// of a key wins.
    [[nodiscard]] static ConfigReader ReadFile(const std::string& fileName, const std::vector<std::string>& overrides);

    /// The same for a text; errors name it fileName.
    [[nodiscard]] static ConfigReader ReadText(
        std::string_view text,
        const std::string& fileName,
        const std::vector<std::string>& overrides);

    [[nodiscard]] ConfigSection GetRoot() const;

    /// Adds an error of the key with that path ("robots.LR01.home"; no name in it has a dot), with the line of the key, or that
    /// of its table if the key is absent.
    void AddError(const std::string& path, const std::string& text) const;

    /// All errors, by line, those of overrides last: "FILE:LINE: KEY: what is wrong and what is allowed", or
    /// "--set: KEY: …". If empty, all values that the getters returned are valid. If the file cannot be read or is not valid
    /// TOML, that is the only error.
    [[nodiscard]] std::vector<std::string> GetErrors() const;

    /// The value of every given key as text, by path ("mcs.url"). Equal texts mean equal values.
    [[nodiscard]] std::map<std::string, std::string> GetValues() const;
};

} // namespace ACS::Apps
