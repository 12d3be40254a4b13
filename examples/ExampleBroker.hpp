#pragma once

#include <acs/core/ParseNumber.hpp>
#include <acs/vda5050_mosquitto/MosquittoOptions.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

/// A broker as the command line names it; null where the text is no port.
inline std::optional<ACS::VDA5050::MosquittoOptions> ReadBrokerOrNull(std::string host, std::string_view port)
{
    ACS::VDA5050::MosquittoOptions options;
    options.port = ACS::Core::ParseNumberOrNull<std::uint16_t>(port).value_or(0);
    options.host = std::move(host);
    return options.port != 0 ? std::optional(std::move(options)) : std::nullopt;
}
