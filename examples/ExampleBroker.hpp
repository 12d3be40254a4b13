#pragma once

#include <acs/vda5050_mosquitto/MosquittoOptions.hpp>

#include <charconv>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

/// A broker as the command line names it; null where the text is no port.
inline std::optional<ACS::VDA5050::MosquittoOptions> ReadBrokerOrNull(std::string host, std::string_view port)
{
    ACS::VDA5050::MosquittoOptions options;
    const char* const end = port.data() + port.size();
    const auto [rest, error] = std::from_chars(port.data(), end, options.port);
    options.host = std::move(host);
    const bool bPort = error == std::errc() && rest == end && options.port != 0;
    return bPort ? std::optional(std::move(options)) : std::nullopt;
}
