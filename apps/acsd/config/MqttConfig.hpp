#pragma once

#include "common/config/ConfigSection.hpp"
#include "common/config/Url.hpp"
#include <acs/core/IRandom.hpp>
#include <acs/vda5050_mosquitto/MosquittoOptions.hpp>

#include <string>
#include <vector>

namespace ACS::Acsd
{

/// The table `mqtt`: the vehicles' broker and who acsd is there.
struct MqttConfig
{
    Apps::Url url;
    std::string interfaceName = "uagv";
    std::string username; ///< Empty: none.
    std::string password; ///< First line of its file.
    VDA5050::MosquittoTLS tls;
};

/// Relative paths count from the folder of the file. What is not wrong, but should not be so, is added to warnings.
void ReadMqttConfig(
    const Apps::ConfigSection& root,
    const std::string& fileName,
    MqttConfig& config,
    std::vector<std::string>& warnings);

/// With a client id of its own each time, so that a second acsd on the broker does not push the first one out.
[[nodiscard]] VDA5050::MosquittoOptions MakeMqttOptions(const MqttConfig& config, Core::IRandom& random);

} // namespace ACS::Acsd
