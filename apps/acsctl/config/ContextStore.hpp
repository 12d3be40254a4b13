#pragma once

#include "config/Connection.hpp"
#include "config/ContextFile.hpp"

#include <tl/expected.hpp>

#include <string>

namespace ACS::Acsctl
{

/// The configuration file, `acsctl/config.toml` in XDG_CONFIG_HOME, else in ~/.config.
class ContextStore final
{
    std::string _path;

public:
    explicit ContextStore(const Environment& environment);

    /// Nothing if there is no file. The file must be accessible to its user only.
    [[nodiscard]] tl::expected<Contexts, std::string> Load() const;

    /// Replaces the file as a whole, with mode 0600; makes its folder.
    [[nodiscard]] tl::expected<void, std::string> Save(const Contexts& contexts) const;

    [[nodiscard]] const std::string& GetPath() const noexcept;
};

/// The first line of a file with a token, which other users must not be able to read.
[[nodiscard]] tl::expected<std::string, std::string> ReadTokenFile(const std::string& path);

/// Whether the text can be a token: printable ASCII without spaces.
[[nodiscard]] bool IsToken(const std::string& text);

} // namespace ACS::Acsctl
