#pragma once

#include "common/config/ConfigSection.hpp"
#include "common/config/Url.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/vda5050_mosquitto/MosquittoOptions.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// The table `mqtt`: the broker of the vehicles, and acsd's credentials.
struct MqttConfig
{
    std::vector<Apps::Url> urls{
        Apps::Url{}}; ///< One broker, or the nodes of a cluster in the order of their use; never empty.
    std::uint8_t maxQos = 2;
    std::string interfaceName = "uagv";
    std::string username; ///< Empty: none.
    std::string password; ///< First line of its file.
    VDA5050::MosquittoTLS tls;
};

/// Relative paths are relative to the folder of the file. Valid settings that are not advisable are added to `warnings`.
void ReadMqttConfig(
    const Apps::ConfigSection& root,
    const std::string& fileName,
    MqttConfig& config,
    std::vector<std::string>& warnings);

/// The warning that nats-server does not accept these prefixes of topics, where it may be the broker; empty if there is none to give.
[[nodiscard]] std::string WarnOfTopics(const MqttConfig& config, const std::vector<std::string>& topicPrefixes);

/// What the options of the connection depend on besides the table `mqtt`.
struct MqttUse
{
    /// Of a shared store: the client id is made from it, so that the broker disconnects the former leader when a standby takes over.
    /// Empty: the id is random, because the broker would disconnect one acsd when a second one connects.
    std::string identity;
    /// When acsd connects, it sends several requests to every vehicle at once, and every vehicle sends its messages: the limits of
    /// the connection grow with the fleet.
    std::size_t robotCount = 0;
    std::function<bool()> maySend{}; ///< MosquittoOptions::maySend
};

[[nodiscard]] VDA5050::MosquittoOptions MakeMqttOptions(
    const MqttConfig& config,
    Core::IRandom& random,
    const MqttUse& use = {});

} // namespace ACS::Acsd
