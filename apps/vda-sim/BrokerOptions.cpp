#include "vda-sim/BrokerOptions.hpp"

#include "common/config/BrokerUrls.hpp"
#include "common/config/TextFile.hpp"
#include <acs/core/Result.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <utility>

namespace ACS::VdaSim
{
namespace
{

std::string ReadMqttVersion(const std::string& text, VDA5050::EMqttVersion& version)
{
    if (text != "3.1.1" && text != "5")
    {
        return fmt::format("expected 3.1.1 or 5, found {}", Core::QuoteForError(text));
    }
    version = text == "5" ? VDA5050::EMqttVersion::Version5 : VDA5050::EMqttVersion::Version311;
    return {};
}

std::string ReadQosProfile(const std::string& text, VDA5050::QosTable& qos)
{
    if (text != "project" && text != "standard")
    {
        return fmt::format("expected project or standard, found {}", Core::QuoteForError(text));
    }
    qos = VDA5050::QosTable(text == "project" ? VDA5050::EQosProfile::Project : VDA5050::EQosProfile::Standard);
    return {};
}

std::string ReadMaxQos(const std::string& text, std::uint8_t& maxQos)
{
    if (text != "0" && text != "1" && text != "2")
    {
        return fmt::format("expected 0, 1 or 2, found {}", Core::QuoteForError(text));
    }
    maxQos = static_cast<std::uint8_t>(text.front() - '0');
    return {};
}

/// Checks the file at the start, so that an unreadable one is not reported at each attempt to connect.
std::string ReadPath(const std::string& path, std::string& file)
{
    const tl::expected<std::string, std::string> text = Apps::ReadTextFile(path);
    if (!text.has_value())
    {
        return fmt::format("cannot read {}: {}", path, text.error());
    }
    file = path;
    return {};
}

std::string ReadPassword(const std::string& path, std::string& password)
{
    const tl::expected<std::string, std::string> text = Apps::ReadTextFile(path);
    if (!text.has_value())
    {
        return fmt::format("cannot read {}: {}", path, text.error());
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
        [&options](const std::string& text) { return ReadMqttVersion(text, options.version); },
        "MQTT version: 3.1.1 or 5")
        .default_str("3.1.1");
    Apps::AddTextOption(
        app,
        "--qos",
        [&options](const std::string& text) { return ReadQosProfile(text, options.qos); },
        "QoS profile: project (order and instantActions 2, state and connection 1, others 0) or standard (connection 1, "
        "others 0)")
        .default_str("project");
    Apps::AddTextOption(
        app,
        "--max-qos",
        [&options](const std::string& text) { return ReadMaxQos(text, options.maxQos); },
        "Highest QoS that the broker supports: a higher one is lowered to it (1 for nats-server 2.9)")
        .default_str("2")
        ->type_name("QOS");
    Apps::AddTextOption(
        app,
        "--user",
        [&options](const std::string& text) {
            options.username = text;
            return std::string();
        },
        "MQTT user name of all vehicles (default: none)")
        .type_name("NAME");
    Apps::AddTextOption(
        app,
        "--password-file",
        [&options](const std::string& path) { return ReadPassword(path, options.password); },
        "File with the password of --user in its first line")
        .type_name("FILE");
    const auto addFile = [&app](const std::string& name, std::string& file, const std::string& help) {
        Apps::AddTextOption(
            app,
            name,
            [&file](const std::string& path) { return ReadPath(path, file); },
            help)
            .type_name("FILE.pem");
    };
    addFile(
        "--tls-ca",
        options.tls.caFile,
        "CA certificates that verify a broker at mqtts (default: the system's CAs)");
    addFile(
        "--tls-certificate",
        options.tls.certFile,
        "Client certificate of the vehicles, for a broker that requires one");
    addFile("--tls-key", options.tls.keyFile, "Private key of --tls-certificate, without a passphrase");
}

std::string CheckBrokerOptions(const BrokerOptions& options, const std::vector<Apps::Url>& brokers)
{
    if (const std::string error = Apps::CheckBrokerURLs(brokers); !error.empty())
    {
        return "--broker: " + error;
    }
    const VDA5050::MosquittoTLS& tls = options.tls;
    const bool bTlsGiven = !tls.caFile.empty() || !tls.certFile.empty() || !tls.keyFile.empty();
    if (bTlsGiven && !Apps::IsSecure(brokers.front().scheme))
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
