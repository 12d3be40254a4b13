#pragma once

#include "config/Connection.hpp"
#include "config/ContextFile.hpp"

#include <tl/expected.hpp>

#include <cstddef>
#include <string>

namespace ACS::Acsctl
{

/// Longest token, and largest file with one, in bytes.
constexpr std::size_t LONGEST_TOKEN = 4096;

/// The configuration file, `acsctl/config.toml` in XDG_CONFIG_HOME, else in HOME/.config. There is none if neither is an absolute path.
class ContextStore final
{
    std::string _path;

public:
    explicit ContextStore(const Environment& environment);

    /// Nothing if there is no file. The file must belong to the user of this process and be accessible to no other.
    [[nodiscard]] tl::expected<Contexts, std::string> Load() const;

    /// Replaces the file as a whole, with mode 0600; makes its folder. Of a symbolic link the target is replaced. A text that Load
    /// would not read is refused.
    [[nodiscard]] tl::expected<void, std::string> Save(const Contexts& contexts) const;

    /// Empty: there is none.
    [[nodiscard]] const std::string& GetPath() const noexcept;
};

/// The first line of a file with a token, which other users must not be able to read.
[[nodiscard]] tl::expected<std::string, std::string> ReadTokenFile(const std::string& path);

/// Whether the text can be a token: printable ASCII without spaces, at most LONGEST_TOKEN.
[[nodiscard]] bool IsToken(const std::string& text);

} // namespace ACS::Acsctl
