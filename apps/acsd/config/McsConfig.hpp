#pragma once

#include "common/config/ConfigSection.hpp"
#include "common/config/Url.hpp"
#include "mcs/MessageStyle.hpp"
#include <acs/protocol/SessionOptions.hpp>
#include <acs/protocol_beast/HttpHeaders.hpp>
#include <acs/protocol_beast/TlsOptions.hpp>

#include <chrono>
#include <cstddef>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// The table `mcs`, and what else says how acsd talks to the MCS.
struct McsConfig
{
    Apps::Url url;
    std::string host;                   ///< Host header; empty: that of the url.
    ProtocolBeast::TlsOptions tls{};    ///< For wss; its files are good.
    ProtocolBeast::HttpHeaders headers; ///< Of the upgrade, besides its own.
    std::chrono::milliseconds pingInterval{10'000};
    std::size_t warnBytes = 4096; ///< Of a text that is sent; 0: never.
    Protocol::SessionOptions session{};
    MessageStyle style;
};

/// Reads the tables `mcs`, `position`, `outbox`, `errors` and `ext`. Relative paths count from the folder of the file.
/// Mistakes in files that they name are added to mistakes.
void ReadMcsConfig(
    const Apps::ConfigSection& root,
    const std::string& fileName,
    McsConfig& config,
    std::vector<std::string>& mistakes);

/// Paths in the configuration count from its own folder.
[[nodiscard]] std::string ResolvePath(const std::string& configFile, const std::string& path);

} // namespace ACS::Acsd
