#pragma once

#include "common/config/CommandLine.hpp"
#include "common/config/Url.hpp"
#include <acs/vda5050/QosTable.hpp>
#include <acs/vda5050_mosquitto/MosquittoOptions.hpp>

#include <string>

namespace ACS::VdaSim
{

/// How the vehicles speak to the broker, beside its address.
struct BrokerOptions
{
    VDA5050::EMqttVersion version = VDA5050::EMqttVersion::Version311;
    VDA5050::QosTable qos;
    std::string username; ///< Empty: none.
    std::string password;
    VDA5050::MosquittoTLS tls; ///< For a broker at mqtts.
};

/// --mqtt, --qos, --user, --password-file, --tls-ca, --tls-certificate and --tls-key. The target must outlive parsing.
void AddBrokerOptions(CLI::App& app, BrokerOptions& options);

/// What does not go together, or nothing.
[[nodiscard]] std::string CheckBrokerOptions(const BrokerOptions& options, Apps::EUrlScheme scheme);

} // namespace ACS::VdaSim
