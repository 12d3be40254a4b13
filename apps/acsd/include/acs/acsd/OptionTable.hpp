#pragma once

#include <acs/core/Api.hpp>

#include <chrono>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Acsd
{

/// A host name or address, and a port that is not 0.
struct TcpAddress
{
    std::string host;       ///< A name, an IPv4 address, or an IPv6 address.
    std::uint16_t port = 0; ///< 1 to 65535 if the address is valid.

    bool operator==(const TcpAddress&) const = default;
};

/// A table of options in the configuration (TOML). On an error a getter adds it to the errors of the configuration
/// ("FILE:LINE: KEY: what is wrong and what is allowed") and returns the default, or an empty value if the key is required.
/// Getters with a default read an optional key, those without one a required key. A key that nothing reads is an error too.
/// Cheap to copy.
class ACS_API OptionTable final
{
public:
    class ACS_HIDDEN Impl;

private:
    std::shared_ptr<const Impl> _impl;

public:
    /// For acsd.
    explicit OptionTable(std::shared_ptr<const Impl> impl) noexcept;

    /// The whole text as one table, for tests of a driver.
    [[nodiscard]] static OptionTable ReadText(std::string_view text, const std::string& fileName);

    /// A string; may be empty.
    [[nodiscard]] std::string GetString(const std::string& key) const;
    /// Likewise; the fallback if the key is absent.
    [[nodiscard]] std::string GetString(const std::string& key, const std::string& fallback) const;

    /// One of the words.
    [[nodiscard]] std::string GetWord(const std::string& key, std::initializer_list<std::string_view> words) const;
    /// Likewise; the fallback if the key is absent.
    [[nodiscard]] std::string GetWord(
        const std::string& key,
        std::initializer_list<std::string_view> words,
        const std::string& fallback) const;

    /// An integer from min to max, both allowed.
    [[nodiscard]] std::int64_t GetInteger(const std::string& key, std::int64_t min, std::int64_t max) const;
    /// Likewise; the fallback if the key is absent.
    [[nodiscard]] std::int64_t GetInteger(
        const std::string& key,
        std::int64_t min,
        std::int64_t max,
        std::int64_t fallback) const;

    /// A number (integers too) from min to max, both allowed.
    [[nodiscard]] double GetNumber(const std::string& key, double min, double max) const;
    /// Likewise; the fallback if the key is absent.
    [[nodiscard]] double GetNumber(const std::string& key, double min, double max, double fallback) const;

    /// true or false
    [[nodiscard]] bool IsEnabled(const std::string& key, bool bFallback) const;

    /// A string such as '200ms', '5s', '2m', '1h', from min to max, both allowed.
    [[nodiscard]] std::chrono::milliseconds GetDuration(
        const std::string& key,
        std::chrono::milliseconds min,
        std::chrono::milliseconds max,
        std::chrono::milliseconds fallback) const;

    /// A required URL "tcp://HOST:PORT".
    [[nodiscard]] TcpAddress GetTcpAddress(const std::string& key) const;

    /// A list of strings; empty if the key is absent.
    [[nodiscard]] std::vector<std::string> GetStringList(const std::string& key) const;

    /// The table of that name. If it is absent, each required key that is read from it is an error.
    [[nodiscard]] OptionTable GetTable(const std::string& name) const;

    /// Every key of this table, sorted: for tables whose keys are names.
    [[nodiscard]] std::vector<std::string> GetNames() const;

    /// Whether the key or table is given. Makes it a known key.
    [[nodiscard]] bool HasKey(const std::string& key) const;

    /// Adds an error that only the driver can detect, with the line of that key; an empty key means the table itself. Only the
    /// first error of a key is kept.
    void AddError(const std::string& key, const std::string& text) const;

    /// Adds a warning about a valid value that is not advisable, or has no effect. `acsd --check-config` and the log at a start show it.
    void AddWarning(const std::string& key, const std::string& text) const;

    /// "robots.LR01.options"
    [[nodiscard]] const std::string& GetPath() const noexcept;

    /// All errors of the document, by line, with those for unknown keys.
    [[nodiscard]] std::vector<std::string> GetErrors() const;

    /// The warnings of this table and those around it and in it, in their order: "robots.LR01.options.speed: …"
    [[nodiscard]] std::vector<std::string> GetWarnings() const;
};

} // namespace ACS::Acsd
