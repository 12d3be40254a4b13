#pragma once

#include <tl/expected.hpp>

#include <map>
#include <string>
#include <string_view>

namespace ACS::Acsctl
{

/// A named acsd; empty texts are absent.
struct Context
{
    std::string url;
    std::string token;
    std::string tokenFile;
    std::string ca;
    std::string certificate;
    std::string key;

    bool operator==(const Context&) const = default;
};

/// The configuration file.
struct Contexts
{
    std::string current; ///< Empty: none.
    std::map<std::string, Context> entries;

    bool operator==(const Contexts&) const = default;
};

/// Reads the text of a configuration file. All errors, one a line, name the file.
[[nodiscard]] tl::expected<Contexts, std::string> ReadContexts(std::string_view text, const std::string& fileName);

/// The text that ReadContexts reads.
[[nodiscard]] std::string WriteContexts(const Contexts& contexts);

/// Letters, digits and . _ -, at most 64.
[[nodiscard]] bool IsContextName(std::string_view name);

} // namespace ACS::Acsctl
