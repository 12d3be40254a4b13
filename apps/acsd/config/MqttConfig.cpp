#include "config/MqttConfig.hpp"

#include "common/config/BrokerUrls.hpp"
#include "common/config/TextFile.hpp"
#include "config/McsConfig.hpp"
#include "config/SecretCheck.hpp"
#include <acs/core/Uuid.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string_view>
#include <utility>

namespace ACS::Acsd
{

namespace
{

using Apps::ConfigSection;
using Apps::EUrlScheme;

constexpr std::int64_t MOST_QOS = 2;

/// That may wait at the same time.
constexpr std::size_t MESSAGES_OF_ROBOT = 20;

std::vector<Apps::Url> ReadURLs(const ConfigSection& mqtt)
{
    const std::string key = "urls";
    if (!mqtt.HasKey(key))
    {
        return {mqtt.GetURL("url", Apps::GetBrokerSchemes())};
    }
    std::vector<Apps::Url> urls;
    for (const std::string& text : mqtt.GetStringList(key))
    {
        Core::Result<Apps::Url> url = Apps::ParseURL(text, Apps::GetBrokerSchemes());
        if (!url.has_value())
        {
            mqtt.AddError(key, Core::Describe(url.error()));
            return {Apps::Url{}};
        }
        urls.push_back(std::move(*url));
    }
    if (mqtt.HasKey("url"))
    {
        mqtt.AddError(
            key,
            "mqtt.url is given too; keep mqtt.url for one broker, or mqtt.urls for the nodes of a cluster");
    }
    if (const std::string error = Apps::CheckBrokerURLs(urls); !error.empty())
    {
        mqtt.AddError(key, error);
        return {Apps::Url{}};
    }
    return urls;
}

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
    for (const Apps::Url& url : config.urls)
    {
        WarnOfPlainSecret("mqtt." + key, url, "mqtts", warnings);
    }
}

/// The files are read at each connect. They are checked here too, to report a missing one at the start.
void ReadTLS(const ConfigSection& mqtt, const std::string& fileName, MqttConfig& config)
{
    const bool bPlain = config.urls.front().scheme == EUrlScheme::Mqtt;
    const std::string_view urlKey = mqtt.HasKey("urls") ? "urls" : "url";
    const auto readPath = [&](const std::string& key) {
        const std::string file = mqtt.GetString(key, "");
        if (file.empty())
        {
            return std::string();
        }
        if (bPlain)
        {
            mqtt.AddError(
                key,
                fmt::format("is for mqtts:// only, and mqtt.{} is mqtt://, which encrypts nothing", urlKey));
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
    config.urls = ReadURLs(mqtt);
    config.maxQos = static_cast<std::uint8_t>(mqtt.GetInteger("max_qos", 0, MOST_QOS, MOST_QOS));
    config.interfaceName = mqtt.GetString("interface_name", config.interfaceName);
    if (config.interfaceName.empty() || config.interfaceName.find_first_of("/+#$") != std::string::npos)
    {
        mqtt.AddError("interface_name", "must be one level of a topic: not empty, without / + # $");
    }
    ReadPassword(mqtt, fileName, config, warnings);
    ReadTLS(mqtt, fileName, config);
}

/// nats-server 2.9 closes a connection at a message of QoS 2: without max_qos a single broker is another one.
std::string WarnOfTopics(const MqttConfig& config, const std::vector<std::string>& topicPrefixes)
{
    const bool bNatsPossible = config.urls.size() > 1 || config.maxQos < MOST_QOS;
    const auto isRefused = [](const std::string& prefix) {
        return prefix.find_first_of(". ") != std::string::npos;
    };
    const auto found = std::ranges::find_if(topicPrefixes, isRefused);
    if (!bNatsPossible || found == topicPrefixes.end())
    {
        return {};
    }
    const auto count = std::ranges::count_if(topicPrefixes, isRefused);
    return fmt::format(
        "mqtt: {} of {} robots have topics with a '.' or a blank, such as '{}'. nats-server 2.9 refuses to subscribe to them and "
        "disconnects a client that publishes to them; change interface_name, manufacturer or serial, or use another broker",
        count,
        topicPrefixes.size(),
        *found);
}

VDA5050::MosquittoOptions MakeMqttOptions(const MqttConfig& config, Core::IRandom& random, const MqttUse& use)
{
    VDA5050::MosquittoOptions options;
    options.clientID = "acsd-" + (use.identity.empty() ? Core::MakeUUID(random) : use.identity);
    options.host = config.urls.front().peer.host;
    options.port = config.urls.front().peer.port;
    std::transform(
        config.urls.begin() + 1,
        config.urls.end(),
        std::back_inserter(options.furtherBrokers),
        [](const Apps::Url& url) {
            return VDA5050::MosquittoBroker{url.peer.host, url.peer.port};
        });
    options.maxQos = config.maxQos;
    options.maySend = use.maySend;
    options.maxUnsent = std::max(options.maxUnsent, MESSAGES_OF_ROBOT * use.robotCount);
    options.maxEarly = std::max(options.maxEarly, MESSAGES_OF_ROBOT * use.robotCount);
    options.username = config.username;
    options.password = config.password;
    if (Apps::IsSecure(config.urls.front().scheme))
    {
        options.tls = config.tls;
    }
    return options;
}

} // namespace ACS::Acsd
