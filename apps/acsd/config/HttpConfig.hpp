#pragma once

#include "common/config/ConfigSection.hpp"
#include "common/config/Endpoint.hpp"

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

/// The two HTTP interfaces.
struct HttpConfig
{
    HttpListenConfig monitoring{{"127.0.0.1", 8080}};
    HttpListenConfig control{{"127.0.0.1", 8081}};
};

/// Reads the tables `http` and `operator`.
void ReadHttpConfig(const Apps::ConfigSection& root, HttpConfig& config);

} // namespace ACS::Acsd
