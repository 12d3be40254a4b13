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

/// The table `mcs`, and all other keys of the communication with the MCS.
struct McsConfig
{
    Apps::Url url;
    std::string host;                   ///< Host header; empty: that of the url.
    ProtocolBeast::TlsOptions tls{};    ///< For wss; its files have been checked.
    ProtocolBeast::HttpHeaders headers; ///< Additional headers of the upgrade request.
    std::chrono::milliseconds pingInterval{10'000};
    std::size_t warnBytes = 4096; ///< A longer message is logged; 0 disables.
    Protocol::SessionOptions session{};
    MessageStyle style;
};

/// Reads the tables `mcs`, `position`, `outbox`, `errors` and `ext`. Relative paths are relative to the folder of the file.
/// Errors in the files that they name are added to `errors`, valid settings that are not advisable to `warnings`.
void ReadMcsConfig(
    const Apps::ConfigSection& root,
    const std::string& fileName,
    McsConfig& config,
    std::vector<std::string>& errors,
    std::vector<std::string>& warnings);

/// Relative paths in the configuration are relative to its own folder. At the begin of a path, `${CREDENTIALS_DIRECTORY}` is the
/// folder where systemd puts the credentials of the service.
[[nodiscard]] std::string ResolvePath(const std::string& configFile, const std::string& path);

} // namespace ACS::Acsd
