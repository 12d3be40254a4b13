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

/// The tables of a configuration, the keys that the program knows, and the mistakes found. Shared by its sections.
class ConfigDocument final
{
    struct Mistake
    {
        bool bOverride;
        std::uint32_t line;
        std::string text;
    };

    std::string _fileName;
    toml::table _root; ///< Each node names its source: the file or --set.
    std::vector<Mistake> _mistakes;
    std::set<std::string> _mistaken; ///< Paths that have a mistake.
    std::set<std::string> _refused;  ///< Paths of tables that were refused as a whole.
    std::map<const toml::table*, std::set<std::string>> _knownKeys;
    std::set<const toml::node*> _accepted; ///< Values that may contain any key.
    bool _bUnreadable = false;

public:
    ConfigDocument(std::string_view text, std::string fileName);

    /// A document with one mistake and nothing else.
    static std::shared_ptr<ConfigDocument> MakeUnreadable(std::string fileName, const std::string& reason);

    /// Applies "table.key=value". Tables are merged key by key; anything else is replaced.
    void Override(const std::string& text);

    [[nodiscard]] const toml::table& GetRoot() const noexcept;

    /// Makes the key known in this table.
    void AddKnownKey(const toml::table& table, const std::string& key);

    /// Makes every key inside the value known.
    void AcceptAll(const toml::node& value);

    /// At the line of the node; without one, at the file. Only the first mistake of a path is kept, and none inside a
    /// refused table.
    void AddError(const toml::node* nodeOrNull, const std::string& path, const std::string& text);

    /// The same for a table as a whole.
    void RefuseTable(const toml::node* nodeOrNull, const std::string& path, const std::string& text);

    /// The node at the path, or its nearest parent that exists; nullptr if there is none. No part of the path has a dot.
    [[nodiscard]] const toml::node* FindNearestOrNull(const std::string& path) const;

    /// With the unknown keys, sorted by line.
    [[nodiscard]] std::vector<std::string> MakeConfigErrors() const;

    /// Every value by its path; a list is one value.
    [[nodiscard]] std::map<std::string, std::string> MakeValues() const;

    /// "mcs" and "url" make "mcs.url"; a key with other characters is quoted.
    [[nodiscard]] static std::string JoinPath(const std::string& path, const std::string& key);

private:
    void AddErrorAt(const toml::source_region& source, const std::string& path, const std::string& text);
    [[nodiscard]] toml::source_region GetSource(const toml::node* nodeOrNull) const;
    [[nodiscard]] Mistake MakeConfigError(
        const toml::source_region& source,
        const std::string& path,
        const std::string& text) const;
    [[nodiscard]] bool IsInRefused(const std::string& path) const;
    void FindUnknown(std::vector<Mistake>& out) const;
    void Merge(toml::table source);
};

} // namespace ACS::Apps
