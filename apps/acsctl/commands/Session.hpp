#pragma once

#include "commands/CommandError.hpp"
#include "config/Connection.hpp"
#include "http/ApiClient.hpp"
#include "http/EventLoop.hpp"
#include "options/AcsctlOptions.hpp"

#include <memory>
#include <string>

namespace ACS::Acsctl
{

/// The connection of a command to acsd, from the command line, the environment and the configuration file.
class Session final
{
    EventLoop _loop;
    std::unique_ptr<ApiClient> _client;
    std::string _url;

public:
    /// Reads the configuration file, the token and the files of TLS; sends nothing.
    [[nodiscard]] Outcome<void> Open(const AcsctlOptions& options, const Environment& environment);

    [[nodiscard]] EventLoop& GetLoop() noexcept;
    /// Only after Open.
    [[nodiscard]] IApi& GetAPI() noexcept;
    [[nodiscard]] const std::string& GetURL() const noexcept;
};

} // namespace ACS::Acsctl
