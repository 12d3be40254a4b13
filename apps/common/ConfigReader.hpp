#pragma once

#include "common/ConfigSection.hpp"

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Apps
{

/// Reads a TOML file and the overrides of the command line, and collects every mistake instead of stopping at the
/// first: ask the sections for all keys, then look at GetMistakes(). Keys that nobody asked for are mistakes too.
class ConfigReader final
{
    std::shared_ptr<ConfigDocument> _document;

    explicit ConfigReader(std::shared_ptr<ConfigDocument> document);

public:
    /// A regular file of at most 4 MiB. Overrides: "table.key=value", the value in TOML, anything else is taken as a string. A later one wins.
    [[nodiscard]] static ConfigReader ReadFile(const std::string& fileName, const std::vector<std::string>& overrides);

    /// The same for text; the name stands in the mistakes.
    [[nodiscard]] static ConfigReader ReadText(
        std::string_view text,
        const std::string& fileName,
        const std::vector<std::string>& overrides);

    [[nodiscard]] ConfigSection GetRoot() const;

    /// Notes a mistake of the key with that path ("robots.LR01.home"), whose parts have no dots, at its line, or where it is
    /// not given at the line of its table.
    void AddMistake(const std::string& path, const std::string& text) const;

    /// All mistakes, by line, those of overrides last: "FILE:LINE: KEY: what is wrong and what is allowed", or
    /// "--set: KEY: …". Empty: every value that the getters returned is good. Where the file cannot be read or is no
    /// TOML, that is the only one.
    [[nodiscard]] std::vector<std::string> GetMistakes() const;

    /// Every key that is given, with its path ("mcs.url") and its value as text: two readings with the same text are the same.
    [[nodiscard]] std::map<std::string, std::string> GetValues() const;
};

} // namespace ACS::Apps
