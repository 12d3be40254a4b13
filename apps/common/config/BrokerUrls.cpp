#include "common/config/BrokerUrls.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>

namespace ACS::Apps
{

namespace
{

/// Names of hosts have no case.
std::string MakeComparable(const Url& url)
{
    std::string text = MakeText(url.peer);
    std::ranges::transform(text, text.begin(), [](unsigned char character) {
        return static_cast<char>(std::tolower(character));
    });
    return text;
}

} // namespace

const std::vector<EUrlScheme>& GetBrokerSchemes()
{
    static const std::vector<EUrlScheme> SCHEMES{EUrlScheme::Mqtt, EUrlScheme::Mqtts};
    return SCHEMES;
}

std::string CheckBrokerURLs(const std::vector<Url>& urls)
{
    if (urls.empty())
    {
        return "is empty; give the URL of each node of the broker cluster";
    }
    std::set<std::string> seen;
    for (const Url& url : urls)
    {
        if (!seen.insert(MakeComparable(url)).second)
        {
            return fmt::format("{} is given twice; give each node of the broker cluster once", MakeText(url.peer));
        }
        if (url.scheme != urls.front().scheme)
        {
            return "has mqtt:// and mqtts://; give one scheme, or an outage could lead from an encrypted connection to a plain one";
        }
    }
    return {};
}

} // namespace ACS::Apps
