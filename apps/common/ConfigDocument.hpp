#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace ACS::Apps
{

/// One value of a configuration, with the place that it came from. Knows nothing of TOML.
struct ConfigNode
{
    using Table = std::map<std::string, std::unique_ptr<ConfigNode>>;
    using Array = std::vector<std::unique_ptr<ConfigNode>>;

    /// What no key takes: dates and times.
    struct Other
    {
    };

    bool bOverride = false; ///< From --set.
    std::uint32_t line = 0; ///< In the file; 0 where unknown.
    std::variant<Table, Array, std::string, std::int64_t, double, bool, Other> value;
};

/// The tree behind a ConfigReader, what was asked of it, and the mistakes found. Shared by its sections.
class ConfigDocument final
{
    struct Mistake
    {
        bool bOverride;
        std::uint32_t line;
        std::string text;
    };

    std::string _fileName;
    ConfigNode _root;
    std::vector<Mistake> _mistakes;
    std::set<std::string> _mistaken; ///< The paths of these.
    std::set<std::string> _refused;  ///< Of tables as a whole: nothing in them is a mistake besides.
    std::map<std::string, std::set<std::string>> _askedByTable;
    bool _bUnreadable = false;

public:
    ConfigDocument(std::string_view text, std::string fileName);

    /// A document that holds nothing but one mistake.
    static std::shared_ptr<ConfigDocument> MakeUnreadable(std::string fileName, const std::string& reason);

    /// Puts "table.key=value" in its place.
    void Override(const std::string& text);

    [[nodiscard]] const ConfigNode& GetRoot() const noexcept;

    /// Remembers that the program knows this key.
    void NoteAsked(const std::string& tablePath, const std::string& key);

    /// The same for every key inside a value.
    void NoteAllAsked(const ConfigNode& value, const std::string& path);

    /// At the line of the node; without one, at the file. Of a key only the first is told, as the others come of it.
    void AddMistake(const ConfigNode* nodeOrNull, const std::string& path, const std::string& text);

    /// The same for a table as a whole, whose keys are not looked at.
    void RefuseTable(const ConfigNode* nodeOrNull, const std::string& path, const std::string& text);

    /// The node of the path, or of as much of it as there is; nullptr for none of it. No part of it has a dot.
    [[nodiscard]] const ConfigNode* FindNearestOrNull(const std::string& path) const;

    /// With the unknown keys, sorted.
    [[nodiscard]] std::vector<std::string> MakeMistakes() const;

    /// Every leaf of the tree by its path; a list is one leaf.
    [[nodiscard]] std::map<std::string, std::string> MakeValues() const;

    /// "mcs" and "url" make "mcs.url"; a key with other characters is quoted.
    [[nodiscard]] static std::string JoinPath(const std::string& path, const std::string& key);

private:
    [[nodiscard]] bool IsInRefused(const std::string& path) const;
    [[nodiscard]] std::string MakeOrigin(const ConfigNode* nodeOrNull) const;
    void FindUnknown(std::vector<Mistake>& out) const;
    [[nodiscard]] bool WasAsked(const std::string& tablePath, const std::string& key) const;
    [[nodiscard]] std::string MakeUnknownText(const std::string& tablePath, const std::string& key) const;
};

} // namespace ACS::Apps
