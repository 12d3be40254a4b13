#pragma once

#include "common/config/ConfigSection.hpp"

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Apps
{

/// Reads a TOML file and the overrides of the command line, and collects every mistake instead of stopping at the
/// first: read all keys from the sections, then check GetErrors(). Keys that were not read are mistakes too.
class ConfigReader final
{
    std::shared_ptr<ConfigDocument> _document;

    explicit ConfigReader(std::shared_ptr<ConfigDocument> document);

public:
    /// A regular file of at most 4 MiB. Overrides: "table.key=value". A value that is not TOML is a string; the last override
    /// of a key wins.
    [[nodiscard]] static ConfigReader ReadFile(const std::string& fileName, const std::vector<std::string>& overrides);

    /// The same for text; the mistakes show the name.
    [[nodiscard]] static ConfigReader ReadText(
        std::string_view text,
        const std::string& fileName,
        const std::vector<std::string>& overrides);

    [[nodiscard]] ConfigSection GetRoot() const;

    /// Adds a mistake of the key with that path ("robots.LR01.home"; no name in it has a dot), at the line of the key, or at
    /// that of its table if the key is absent.
    void AddError(const std::string& path, const std::string& text) const;

    /// All mistakes, by line, those of overrides last: "FILE:LINE: KEY: what is wrong and what is allowed", or
    /// "--set: KEY: …". Empty: every value that the getters returned is valid. If the file cannot be read or is not valid
    /// TOML, that is the only mistake.
    [[nodiscard]] std::vector<std::string> GetErrors() const;

    /// The value of every given key as text, by path ("mcs.url"). Equal texts mean equal values.
    [[nodiscard]] std::map<std::string, std::string> GetValues() const;
};

} // namespace ACS::Apps
