#include "vda-sim/BrokerOptions.hpp"

#include "common/config/TextFile.hpp"
#include <acs/core/Result.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <utility>

namespace ACS::VdaSim
{
namespace
{

std::string TakeMqttVersion(const std::string& text, VDA5050::EMqttVersion& version)
{
    if (text != "3.1.1" && text != "5")
    {
        return fmt::format("expected 3.1.1 or 5, found {}", Core::QuoteForError(text));
    }
    version = text == "5" ? VDA5050::EMqttVersion::Version5 : VDA5050::EMqttVersion::Version311;
    return {};
}

std::string TakeQosProfile(const std::string& text, VDA5050::QosTable& qos)
{
    if (text != "project" && text != "standard")
    {
        return fmt::format("expected project or standard, found {}", Core::QuoteForError(text));
    }
    qos = VDA5050::QosTable(text == "project" ? VDA5050::EQosProfile::Project : VDA5050::EQosProfile::Standard);
    return {};
}

/// Told at the start, and not at each attempt to connect.
std::string TakeFile(const std::string& path, std::string& file)
{
    const tl::expected<std::string, std::string> text = Apps::ReadTextFile(path);
    if (!text.has_value())
    {
        return fmt::format("{} cannot be read: {}", path, text.error());
    }
    file = path;
    return {};
}

std::string TakePassword(const std::string& path, std::string& password)
{
    const tl::expected<std::string, std::string> text = Apps::ReadTextFile(path);
    if (!text.has_value())
    {
        return fmt::format("{} cannot be read: {}", path, text.error());
    }
    password = text->substr(0, text->find_first_of("\r\n"));
    return password.empty() ? fmt::format("{} has no password in its first line", path) : std::string();
}

} // namespace

void AddBrokerOptions(CLI::App& app, BrokerOptions& options)
{
    Apps::AddTextOption(
        app,
        "--mqtt",
        [&options](const std::string& text) { return TakeMqttVersion(text, options.version); },
        "MQTT version: 3.1.1 or 5")
        .default_str("3.1.1");
    Apps::AddTextOption(
        app,
        "--qos",
        [&options](const std::string& text) { return TakeQosProfile(text, options.qos); },
        "qualities of service: project (order and instantActions 2, state and connection 1, else 0) or standard "
        "(connection 1, else 0)")
        .default_str("project");
    Apps::AddTextOption(
        app,
        "--user",
        [&options](const std::string& text) {
            options.username = text;
            return std::string();
        },
        "user of the broker, for all vehicles")
        .type_name("NAME");
    Apps::AddTextOption(
        app,
        "--password-file",
        [&options](const std::string& path) { return TakePassword(path, options.password); },
        "a file whose first line is the password of --user")
        .type_name("FILE");
    const auto addFile = [&app](const std::string& name, std::string& file, const std::string& help) {
        Apps::AddTextOption(
            app,
            name,
            [&file](const std::string& path) { return TakeFile(path, file); },
            help)
            .type_name("FILE.pem");
    };
    addFile(
        "--tls-ca",
        options.tls.caFile,
        "whose certificates a broker at mqtts may show; by default the system's CAs");
    addFile("--tls-certificate", options.tls.certFile, "the vehicles' certificate, where the broker asks for one");
    addFile("--tls-key", options.tls.keyFile, "the key of --tls-certificate, without a passphrase");
}

std::string CheckBrokerOptions(const BrokerOptions& options, Apps::EUrlScheme scheme)
{
    const VDA5050::MosquittoTLS& tls = options.tls;
    const bool bTlsGiven = !tls.caFile.empty() || !tls.certFile.empty() || !tls.keyFile.empty();
    if (bTlsGiven && !Apps::IsSecure(scheme))
    {
        return "--tls-ca, --tls-certificate and --tls-key are for a broker at mqtts://HOST:PORT";
    }
    if (tls.certFile.empty() != tls.keyFile.empty())
    {
        return "give both --tls-certificate FILE.pem and --tls-key FILE.pem, or none";
    }
    if (options.username.empty() && !options.password.empty())
    {
        return "--password-file needs --user NAME";
    }
    return {};
}

} // namespace ACS::VdaSim
