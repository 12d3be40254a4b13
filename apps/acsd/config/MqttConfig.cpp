#include "config/MqttConfig.hpp"

#include "common/config/TextFile.hpp"
#include "config/McsConfig.hpp"
#include "config/SecretCheck.hpp"
#include <acs/core/Uuid.hpp>

#include <fmt/format.h>

#include <optional>
#include <utility>

namespace ACS::Acsd
{

namespace
{

using Apps::ConfigSection;
using Apps::EUrlScheme;

std::optional<std::string> ReadFileOrNull(const ConfigSection& mqtt, const std::string& key, const std::string& path)
{
    tl::expected<std::string, std::string> text = Apps::ReadTextFile(path);
    if (!text.has_value())
    {
        mqtt.AddError(key, fmt::format("{} cannot be read ({})", path, text.error()));
        return std::nullopt;
    }
    return std::move(*text);
}

void ReadPassword(
    const ConfigSection& mqtt,
    const std::string& fileName,
    MqttConfig& config,
    std::vector<std::string>& warnings)
{
    const std::string key = "password_file";
    config.username = mqtt.GetString("username", "");
    const std::string file = mqtt.GetString(key, "");
    if (file.empty())
    {
        return;
    }
    if (config.username.empty())
    {
        mqtt.AddError(key, "needs mqtt.username: MQTT has no password without a user name");
    }
    const std::string path = ResolvePath(fileName, file);
    const std::optional<std::string> text = ReadFileOrNull(mqtt, key, path);
    if (!text.has_value())
    {
        return;
    }
    config.password = text->substr(0, text->find_first_of("\r\n"));
    if (config.password.empty())
    {
        mqtt.AddError(key, path + " has no password in its first line");
    }
    CheckSecretFile(mqtt, key, path);
    WarnOfPlainSecret("mqtt." + key, config.url, "mqtts", warnings);
}

/// The files are read at each connect. They are checked here too, to report a missing one at the start.
void ReadTLS(const ConfigSection& mqtt, const std::string& fileName, MqttConfig& config)
{
    const bool bPlain = config.url.scheme == EUrlScheme::Mqtt;
    const auto readPath = [&](const std::string& key) {
        const std::string file = mqtt.GetString(key, "");
        if (file.empty())
        {
            return std::string();
        }
        if (bPlain)
        {
            mqtt.AddError(key, "is for mqtts:// only, and mqtt.url is mqtt://, which encrypts nothing");
        }
        std::string path = ResolvePath(fileName, file);
        const std::optional<std::string> text = ReadFileOrNull(mqtt, key, path);
        if (text.has_value() && text->find("-----BEGIN ") == std::string::npos)
        {
            mqtt.AddError(key, path + " is no PEM file");
        }
        return path;
    };
    config.tls.caFile = readPath("ca_file");
    config.tls.certFile = readPath("cert_file");
    config.tls.keyFile = readPath("key_file");
    if (config.tls.certFile.empty() != config.tls.keyFile.empty())
    {
        mqtt.AddError(
            config.tls.certFile.empty() ? "key_file" : "cert_file",
            "needs the other one too: give both mqtt.cert_file and mqtt.key_file, or neither");
    }
    if (!config.tls.keyFile.empty())
    {
        CheckSecretFile(mqtt, "key_file", config.tls.keyFile);
    }
}

} // namespace

void ReadMqttConfig(
    const ConfigSection& root,
    const std::string& fileName,
    MqttConfig& config,
    std::vector<std::string>& warnings)
{
    const ConfigSection mqtt = root.GetSection("mqtt");
    config.url = mqtt.GetURL("url", {EUrlScheme::Mqtt, EUrlScheme::Mqtts});
    config.interfaceName = mqtt.GetString("interface_name", config.interfaceName);
    if (config.interfaceName.empty() || config.interfaceName.find_first_of("/+#$") != std::string::npos)
    {
        mqtt.AddError("interface_name", "must be one level of a topic: not empty, without / + # $");
    }
    ReadPassword(mqtt, fileName, config, warnings);
    ReadTLS(mqtt, fileName, config);
}

VDA5050::MosquittoOptions MakeMqttOptions(const MqttConfig& config, Core::IRandom& random, const std::string& identity)
{
    VDA5050::MosquittoOptions options;
    options.clientID = "acsd-" + (identity.empty() ? Core::MakeUUID(random) : identity);
    options.host = config.url.peer.host;
    options.port = config.url.peer.port;
    options.username = config.username;
    options.password = config.password;
    if (Apps::IsSecure(config.url.scheme))
    {
        options.tls = config.tls;
    }
    return options;
}

} // namespace ACS::Acsd
