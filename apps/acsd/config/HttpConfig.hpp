#pragma once

#include "common/config/ConfigSection.hpp"
#include "common/config/Endpoint.hpp"
#include "common/http/HttpTls.hpp"
#include "common/trace/TraceFiles.hpp"
#include "operator/AccessPolicy.hpp"

#include <string>
#include <vector>

namespace ACS::Acsd
{

/// An HTTP address of acsd.
struct HttpListenConfig
{
    Apps::Endpoint listen;
    std::vector<std::string> hosts{}; ///< Accepted host names, without port.
};

/// The table `operator`.
struct OperatorConfig
{
    HttpListenConfig http{{"127.0.0.1", 8081}};
    std::string tokensFile; ///< Empty: none.
    Apps::HttpTlsFiles tls; ///< Its files have been checked; without a certificate no TLS.
    AccessPolicy::Options access;
    std::string auditDirectory;
    Apps::TraceLimits auditLimits{10U * 1024U * 1024U, 10};
};

/// The two HTTP interfaces.
struct HttpConfig
{
    HttpListenConfig monitoring{{"127.0.0.1", 8080}};
    OperatorConfig control;
};

/// Replaces the tokens by those of the same file. Returns whether they differ.
[[nodiscard]] bool TryReplaceTokens(const OperatorConfig& fresh, OperatorConfig& present);

/// Reads the tables `http` and `operator`. Relative paths are relative to the folder of the file; the audit log is by default
/// in the directory of the store.
void ReadHttpConfig(
    const Apps::ConfigSection& root,
    const std::string& fileName,
    const std::string& storeDirectory,
    HttpConfig& config,
    std::vector<std::string>& warnings);

/// Adds an error if the audit log could not be written to its directory. Changes nothing. The directory of the store need not
/// exist yet: a start creates it first.
void InspectAuditDirectory(
    const Apps::ConfigSection& root,
    const OperatorConfig& config,
    const std::string& storeDirectory);

} // namespace ACS::Acsd
