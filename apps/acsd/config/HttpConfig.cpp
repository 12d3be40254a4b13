#include "config/HttpConfig.hpp"

#include "common/config/TextFile.hpp"
#include "config/McsConfig.hpp"
#include "config/SecretCheck.hpp"
#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string_view>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace ACS::Acsd
{

namespace
{

using Apps::ConfigSection;

constexpr std::size_t LARGEST_TOKENS_FILE = 1024U * 1024U;
constexpr std::int64_t SMALLEST_AUDIT_FILE = 4'096;
constexpr std::int64_t LARGEST_AUDIT_FILE = 1'000'000'000'000;
constexpr std::int64_t MOST_AUDIT_FILES = 10'000;

void ReadListen(const ConfigSection& section, HttpListenConfig& config)
{
    config.listen = section.GetEndpoint("listen", config.listen);
    config.hosts = section.GetStringList("hosts");
    const auto wrong = std::ranges::find_if(config.hosts, [](const std::string& name) {
        return !Apps::ParseEndpoint(name + ":0").has_value();
    });
    if (wrong != config.hosts.end())
    {
        section.AddError(
            "hosts",
            fmt::format(
                R"(expected names without port, such as "acs.example", found {})",
                Core::QuoteForError(*wrong)));
    }
}

void ReadTokens(
    const ConfigSection& section,
    const std::string& fileName,
    OperatorConfig& config,
    std::vector<std::string>& warnings)
{
    const std::optional<std::string> path = section.GetStringOrNull("tokens_file");
    if (!path.has_value())
    {
        return;
    }
    config.tokensFile = ResolvePath(fileName, *path);
    const tl::expected<std::string, std::string> text = Apps::ReadTextFileUpTo(config.tokensFile, LARGEST_TOKENS_FILE);
    if (!text.has_value())
    {
        section.AddError(
            "tokens_file",
            fmt::format(
                "{} cannot be read ({}); acsd token ROLE NAME prints its lines",
                config.tokensFile,
                text.error()));
        return;
    }
    CheckSecretFile(section, "tokens_file", config.tokensFile);
    Core::Result<std::vector<OperatorToken>> tokens = ParseTokens(*text);
    if (!tokens.has_value())
    {
        section.AddError("tokens_file", fmt::format("{}: {}", config.tokensFile, Core::Describe(tokens.error())));
        return;
    }
    if (tokens->empty())
    {
        warnings.push_back(fmt::format(
            "operator.tokens_file: {} has no token, so every token is refused; acsd token ROLE NAME prints its lines",
            config.tokensFile));
    }
    config.access.tokens = std::move(*tokens);
}

/// The files are read again when acsd listens. They are checked here to report their errors with those of the configuration.
void ReadOperatorTLS(const ConfigSection& section, const std::string& fileName, OperatorConfig& config)
{
    if (!section.HasKey("tls"))
    {
        return;
    }
    const ConfigSection tls = section.GetSection("tls");
    const auto readFile = [&](const std::string& key) {
        const std::string path = tls.GetString(key, "");
        return path.empty() ? path : ResolvePath(fileName, path);
    };
    config.tls = {readFile("certificate"), readFile("key"), readFile("client_ca")};
    if (const auto context = Apps::MakeHttpTlsContext(config.tls); !context.has_value())
    {
        Core::Error error = context.error();
        const std::string key = std::exchange(error.path, {});
        tls.AddError(key, Core::Describe(error));
    }
    else if (!config.tls.key.empty())
    {
        CheckSecretFile(tls, "key", config.tls.key);
    }
}

void ReadCertificates(const ConfigSection& section, OperatorConfig& config)
{
    const ConfigSection names = section.GetSection("certificates");
    std::map<std::string, EOperatorRole> roles;
    for (const std::string& name : names.GetNames())
    {
        const std::string role = names.GetWord(name, {"viewer", "operator"});
        roles.emplace(name, ReadRoleOrNull(role).value_or(EOperatorRole::Viewer));
    }
    const bool bUsed = !config.tls.clientCA.empty();
    if (bUsed && roles.empty())
    {
        section.AddError(
            "certificates",
            R"(missing; without it no certificate of operator.tls.client_ca has a role; add for example: )"
            R"(certificates = { "kim" = "operator" })");
    }
    if (!bUsed && !roles.empty())
    {
        section.AddError("certificates", "is used with operator.tls.client_ca only");
    }
    if (bUsed)
    {
        config.access.certificates = std::move(roles);
    }
}

/// Other machines reach the address: who sends a command must be known, and the token must not be readable on the way.
void DemandIdentity(const ConfigSection& section, const OperatorConfig& config)
{
    std::vector<std::string_view> missing;
    if (config.tls.certificate.empty())
    {
        missing.emplace_back(R"(tls = { certificate = "acsd.pem", key = "acsd.key" })");
    }
    if (config.tokensFile.empty() && config.tls.clientCA.empty())
    {
        missing.emplace_back(R"(tokens_file = "tokens")");
    }
    if (!Apps::IsLoopback(config.http.listen.host) && !missing.empty())
    {
        section.AddError(
            "listen",
            fmt::format(
                "{} can be reached from other machines; add to [operator]: {}",
                Apps::MakeText(config.http.listen),
                fmt::join(missing, " and ")));
    }
}

void ReadAudit(
    const ConfigSection& section,
    const std::string& fileName,
    const std::string& storeDirectory,
    bool bSharedStore,
    OperatorConfig& config)
{
    const ConfigSection audit = section.GetSection("audit");
    const std::optional<std::string> directory = audit.GetStringOrNull("directory");
    config.auditDirectory = directory.has_value() ? ResolvePath(fileName, *directory) : storeDirectory + "/audit";
    if (directory.has_value() ? directory->empty() : bSharedStore)
    {
        audit.AddError(
            "directory",
            directory.has_value() ? "is empty; give the path of a directory"
                                  : "is required with store.url; give the path of a directory");
    }
    config.auditLimits.maxFileBytes = static_cast<std::uint64_t>(audit.GetInteger(
        "max_file_bytes",
        SMALLEST_AUDIT_FILE,
        LARGEST_AUDIT_FILE,
        static_cast<std::int64_t>(config.auditLimits.maxFileBytes)));
    config.auditLimits.maxFiles = static_cast<std::size_t>(
        audit.GetInteger("max_files", 1, MOST_AUDIT_FILES, static_cast<std::int64_t>(config.auditLimits.maxFiles)));
}

} // namespace

bool TryReplaceTokens(const OperatorConfig& fresh, OperatorConfig& present)
{
    if (fresh.tokensFile != present.tokensFile || fresh.access.tokens == present.access.tokens)
    {
        return false;
    }
    present.access.tokens = fresh.access.tokens;
    return true;
}

void ReadHttpConfig(
    const ConfigSection& root,
    const std::string& fileName,
    const std::string& storeDirectory,
    HttpConfig& config,
    std::vector<std::string>& warnings)
{
    const ConfigSection control = root.GetSection("operator");
    ReadListen(root.GetSection("http"), config.monitoring);
    ReadListen(control, config.control.http);
    ReadTokens(control, fileName, config.control, warnings);
    ReadOperatorTLS(control, fileName, config.control);
    ReadCertificates(control, config.control);
    DemandIdentity(control, config.control);
    ReadAudit(control, fileName, storeDirectory, root.GetSection("store").HasKey("url"), config.control);
    const Apps::Endpoint& listen = config.control.http.listen;
    if (listen == config.monitoring.listen && listen.port != 0)
    {
        control.AddError(
            "listen",
            fmt::format("{} is also the address of http.listen; give another port", Apps::MakeText(listen)));
    }
}

void InspectAuditDirectory(const ConfigSection& root, const OperatorConfig& config, const std::string& storeDirectory)
{
    const std::filesystem::path directory(config.auditDirectory);
    std::error_code unknown;
    const bool bExists = std::filesystem::exists(directory, unknown);
    const std::filesystem::path parent = directory.has_parent_path() ? directory.parent_path() : ".";
    const std::filesystem::path store = (std::filesystem::path(storeDirectory) / "").parent_path();
    if (config.auditDirectory.empty() || (!bExists && parent == store))
    {
        return;
    }
    const std::filesystem::path written = bExists ? directory : parent;
    if (::access((written / ".").c_str(), W_OK | X_OK) != 0)
    {
        const std::error_code error(errno, std::generic_category());
        root.GetSection("operator")
            .GetSection("audit")
            .AddError(
                "directory",
                fmt::format(
                    "{}: expected a directory that can be written, in one that exists, found {}: {}",
                    config.auditDirectory,
                    written.string(),
                    error.message()));
    }
}

} // namespace ACS::Acsd
