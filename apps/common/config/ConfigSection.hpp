#pragma once

#include "common/config/Endpoint.hpp"
#include "common/config/Url.hpp"
#include <acs/core/Result.hpp>

#include <toml++/toml.h>

#include <chrono>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Apps
{

class ConfigDocument;

/// One table of a configuration. On an error a getter adds it to ConfigReader::GetErrors and returns the default, or an empty
/// value if the key is required: the caller reads all keys and checks once at the end. Getters with a default read an
/// optional key, those without one a required key. Cheap to copy.
class ConfigSection final
{
    std::shared_ptr<ConfigDocument> _document;
    const toml::table* _tableOrNull = nullptr;
    std::string _path;
    const toml::table* _placeOrNull = nullptr; ///< Of errors: the table, or the one around it, but not the root.

public:
    /// For ConfigReader. nullptr: the table is absent.
    ConfigSection(std::shared_ptr<ConfigDocument> document, const toml::table* tableOrNull, std::string path);

    [[nodiscard]] std::string GetString(const std::string& key) const;
    [[nodiscard]] std::string GetString(const std::string& key, const std::string& fallback) const;
    [[nodiscard]] std::optional<std::string> GetStringOrNull(const std::string& key) const;

    /// One of the words.
    [[nodiscard]] std::string GetWord(const std::string& key, std::initializer_list<std::string_view> words) const;
    [[nodiscard]] std::string GetWord(
        const std::string& key,
        std::initializer_list<std::string_view> words,
        const std::string& fallback) const;

    /// An integer from min to max, both allowed.
    [[nodiscard]] std::int64_t GetInteger(const std::string& key, std::int64_t min, std::int64_t max) const;
    [[nodiscard]] std::int64_t GetInteger(
        const std::string& key,
        std::int64_t min,
        std::int64_t max,
        std::int64_t fallback) const;

    /// A number (integers too) from min to max, both allowed.
    [[nodiscard]] double GetNumber(const std::string& key, double min, double max) const;
    [[nodiscard]] double GetNumber(const std::string& key, double min, double max, double fallback) const;

    /// true or false
    [[nodiscard]] bool IsEnabled(const std::string& key, bool bFallback) const;

    /// A string such as '200ms', '5s', '2m', '1h', from min to max, both allowed.
    [[nodiscard]] std::chrono::milliseconds GetDuration(
        const std::string& key,
        std::chrono::milliseconds min,
        std::chrono::milliseconds max,
        std::chrono::milliseconds fallback) const;

    [[nodiscard]] Endpoint GetEndpoint(const std::string& key, const Endpoint& fallback) const;
    [[nodiscard]] Url GetURL(const std::string& key, const std::vector<EUrlScheme>& allowed) const;

    /// A list of strings; empty if the key is absent.
    [[nodiscard]] std::vector<std::string> GetStringList(const std::string& key) const;

    /// The value of an optional key of any type; nullptr if the key is absent. Keys inside the value are not checked.
    [[nodiscard]] const toml::node* FindValueOrNull(const std::string& key) const;

    /// A required string that a function reads: `section.GetParsed<Location>("dock", ParseLocation)`. Its error becomes
    /// the error of the key, a value-initialised TValue the result.
    template <typename TValue, typename TParse>
    [[nodiscard]] TValue GetParsed(const std::string& key, TParse parse) const
    {
        if (!HasKey(key))
        {
            const Core::Result<TValue> nothing = parse(std::string());
            AddMissing(key, nothing.has_value() ? std::string() : nothing.error().expected);
            return TValue{};
        }
        return ParseOr<TValue>(key, ReadStringOrNull(key, false), parse, TValue{});
    }

    /// The same for an optional key.
    template <typename TValue, typename TParse>
    [[nodiscard]] TValue GetParsed(const std::string& key, TParse parse, TValue fallback) const
    {
        return ParseOr<TValue>(key, ReadStringOrNull(key, false), parse, std::move(fallback));
    }

    /// The table of that name. If it is absent, each required key that is read from it is an error.
    [[nodiscard]] ConfigSection GetSection(const std::string& name) const;

    /// A list of tables ([[name]]), in order; empty if it is absent.
    [[nodiscard]] std::vector<ConfigSection> GetSectionList(const std::string& name) const;

    /// Every key of this table, sorted: for tables whose keys are names, such as `robots`.
    [[nodiscard]] std::vector<std::string> GetNames() const;

    /// Whether the key or table is given. Makes it a known key.
    [[nodiscard]] bool HasKey(const std::string& key) const;

    /// Adds an error that only the caller can detect ("no such station in the map") with the line of that key; an empty key
    /// means the table itself. Only the first error of a key is kept.
    void AddError(const std::string& key, const std::string& text) const;

    /// Adds an error if the key is given, because this version no longer reads it. The text names the replacement.
    void ReportRemoved(const std::string& key, std::string_view replacement) const;

    /// Adds an error of this table as a whole. Errors of its keys are ignored.
    void Refuse(const std::string& text) const;

    /// "robots.LR01"
    [[nodiscard]] const std::string& GetPath() const noexcept;

private:
    [[nodiscard]] const toml::node* FindOrNull(const std::string& key) const;
    [[nodiscard]] const toml::node* FindGivenOrNull(const std::string& key) const;
    [[nodiscard]] std::optional<std::string> ReadStringOrNull(const std::string& key, bool bRequired) const;
    [[nodiscard]] std::optional<std::int64_t> ReadIntegerOrNull(
        const std::string& key,
        std::int64_t min,
        std::int64_t max,
        bool bRequired) const;
    [[nodiscard]] std::optional<double> ReadNumberOrNull(const std::string& key, double min, double max, bool bRequired)
        const;
    [[nodiscard]] std::optional<std::string> ReadWordOrNull(
        const std::string& key,
        std::initializer_list<std::string_view> words,
        bool bRequired) const;
    /// The result of the function for the node; adds an error if it returns none.
    template <typename TRead>
    [[nodiscard]] auto ReadOrNull(const std::string& key, bool bRequired, std::string_view allowed, TRead readOrNull)
        const -> decltype(readOrNull(std::declval<const toml::node&>()));
    void AddMissing(const std::string& key, std::string_view allowed) const;
    void AddParseError(const std::string& key, const Core::Error& error) const;

    template <typename TValue, typename TParse>
    [[nodiscard]] TValue ParseOr(
        const std::string& key,
        const std::optional<std::string>& text,
        TParse& parse,
        TValue fallback) const
    {
        if (!text.has_value())
        {
            return fallback;
        }
        Core::Result<TValue> value = parse(*text);
        if (!value.has_value())
        {
            AddParseError(key, value.error());
            return fallback;
        }
        return std::move(*value);
    }
};

} // namespace ACS::Apps
