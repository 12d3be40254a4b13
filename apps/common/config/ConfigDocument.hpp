#pragma once

#include <toml++/toml.h>

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Apps
{

/// The tables of a configuration, the keys that the program knows, and the errors found. Shared by its sections.
class ConfigDocument final
{
    struct ConfigError
    {
        bool bOverride;
        std::uint32_t line;
        std::string text;
    };

    std::string _fileName;
    toml::table _root; ///< Each node names its source: the file or --set.
    std::vector<ConfigError> _errors;
    std::set<std::string> _pathsWithErrors; ///< Only the first error of a path is kept.
    std::set<std::string> _refused;         ///< Paths of tables that were refused as a whole.
    std::map<const toml::table*, std::set<std::string>> _knownKeys;
    std::set<const toml::node*> _accepted; ///< Values that may contain any key.
    bool _bUnreadable = false;

public:
    ConfigDocument(std::string_view text, std::string fileName);

    /// A document with a single error and no content.
    static std::shared_ptr<ConfigDocument> MakeUnreadable(std::string fileName, const std::string& reason);

    /// Applies "table.key=value". Tables are merged key by key; anything else is replaced.
    void Override(const std::string& text);

    [[nodiscard]] const toml::table& GetRoot() const noexcept;

    /// Makes the key known in this table.
    void AddKnownKey(const toml::table& table, const std::string& key);

    /// Makes every key inside the value known.
    void AcceptAll(const toml::node& value);

    /// Adds an error with the line of the node, or without a line if there is no node. Ignored if the path has an error already
    /// or is inside a refused table.
    void AddError(const toml::node* nodeOrNull, const std::string& path, const std::string& text);

    /// Adds an error of a table as a whole; errors inside it are ignored from then on.
    void RefuseTable(const toml::node* nodeOrNull, const std::string& path, const std::string& text);

    /// The node at the path, or its nearest parent that exists; nullptr if there is none. No part of the path has a dot.
    [[nodiscard]] const toml::node* FindNearestOrNull(const std::string& path) const;

    /// All errors, with those for unknown keys, sorted by line.
    [[nodiscard]] std::vector<std::string> MakeConfigErrors() const;

    /// All values by their paths; a list is one value.
    [[nodiscard]] std::map<std::string, std::string> MakeValues() const;

    /// "mcs" and "url" make "mcs.url"; a key with other characters is quoted.
    [[nodiscard]] static std::string JoinPath(const std::string& path, const std::string& key);

private:
    void AddErrorAt(const toml::source_region& source, const std::string& path, const std::string& text);
    [[nodiscard]] toml::source_region GetSource(const toml::node* nodeOrNull) const;
    [[nodiscard]] ConfigError MakeConfigError(
        const toml::source_region& source,
        const std::string& path,
        const std::string& text) const;
    [[nodiscard]] bool IsInRefused(const std::string& path) const;
    void FindUnknown(std::vector<ConfigError>& out) const;
    /// Sets the value of source at the key, to which path and source have one table for each part. A table replaces that of the
    /// file.
    void Replace(const toml::table& path, toml::table source);
};

} // namespace ACS::Apps
