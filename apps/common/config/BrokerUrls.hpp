#pragma once

#include "common/config/Url.hpp"

#include <string>
#include <vector>

namespace ACS::Apps
{

/// mqtt and mqtts.
[[nodiscard]] const std::vector<EUrlScheme>& GetBrokerSchemes();

/// What is wrong with the URLs of the nodes of a broker cluster: none at all, one of them twice, or both schemes. Empty if nothing is.
[[nodiscard]] std::string CheckBrokerURLs(const std::vector<Url>& urls);

} // namespace ACS::Apps
