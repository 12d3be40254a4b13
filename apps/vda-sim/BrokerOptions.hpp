#pragma once

#include "common/config/CommandLine.hpp"
#include "common/config/Url.hpp"
#include <acs/vda5050/QosTable.hpp>
#include <acs/vda5050_mosquitto/MosquittoOptions.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace ACS::VdaSim
{

/// Settings of the connections to the broker, except its addresses.
struct BrokerOptions
{
    VDA5050::EMqttVersion version = VDA5050::EMqttVersion::Version311;
    VDA5050::QosTable qos;
    std::uint8_t maxQos = 2;
    std::string username; ///< Empty: none.
    std::string password;
    VDA5050::MosquittoTLS tls; ///< For a broker at mqtts.
};

/// --mqtt, --qos, --max-qos, --user, --password-file, --tls-ca, --tls-certificate and --tls-key. The target must outlive parsing.
void AddBrokerOptions(CLI::App& app, BrokerOptions& options);

/// Which options contradict each other; empty if none do.
[[nodiscard]] std::string CheckBrokerOptions(const BrokerOptions& options, const std::vector<Apps::Url>& brokers);

} // namespace ACS::VdaSim
