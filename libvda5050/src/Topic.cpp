#include "OrderErrors.hpp"
#include <acs/vda5050/EVda5050Error.hpp>
#include <acs/vda5050/Topic.hpp>

#include <algorithm>
#include <array>
#include <cassert>

namespace ACS::VDA5050
{

namespace
{

constexpr std::string_view MAJOR_VERSION = "v2";
constexpr std::size_t LEVEL_COUNT = 5;

struct TopicRule
{
    ETopic topic;
    std::string_view name;
    std::uint8_t projectQos;
    std::uint8_t standardQos;
    bool bRetained;
};

/// The one table of quality of service and retain.
constexpr std::array<TopicRule, TOPIC_COUNT> RULES{
    TopicRule{ETopic::Order, "order", 2, 0, false},
    TopicRule{ETopic::InstantActions, "instantActions", 2, 0, false},
    TopicRule{ETopic::State, "state", 1, 0, false},
    TopicRule{ETopic::Visualization, "visualization", 0, 0, false},
    TopicRule{ETopic::Connection, "connection", 1, 1, true},
    TopicRule{ETopic::Factsheet, "factsheet", 0, 0, true}};

const TopicRule& GetRule(ETopic topic)
{
    const auto index = static_cast<std::size_t>(topic);
    assert(index < RULES.size() && RULES[index].topic == topic);
    return RULES[index];
}

bool IsControl(char letter)
{
    constexpr unsigned char FIRST_PRINTABLE = 0x20;
    constexpr unsigned char DELETE = 0x7F;
    const auto code = static_cast<unsigned char>(letter);
    return code < FIRST_PRINTABLE || code == DELETE;
}

/// A $ at the beginning is the broker's own; elsewhere section 6.3 only advises against it.
bool IsValidLevel(std::string_view level)
{
    return !level.empty() && level.find_first_of("/+#") == std::string_view::npos && !level.starts_with('$')
        && std::ranges::none_of(level, IsControl);
}

} // namespace

std::string_view GetTopicName(ETopic topic)
{
    return GetRule(topic).name;
}

bool IsRetained(ETopic topic)
{
    return GetRule(topic).bRetained;
}

std::uint8_t GetQos(ETopic topic, EQosProfile profile)
{
    const TopicRule& rule = GetRule(topic);
    return profile == EQosProfile::Project ? rule.projectQos : rule.standardQos;
}

bool IsValidAddress(const VehicleAddress& address)
{
    return IsValidLevel(address.interfaceName) && IsValidLevel(address.manufacturer)
        && IsValidLevel(address.serialNumber);
}

std::optional<Core::Error> FindForeignNameOrNull(const Header& header, const VehicleAddress& address)
{
    const auto isOther = [](const std::string& said, const std::string& own) {
        return !said.empty() && said != own;
    };
    if (!isOther(header.manufacturer, address.manufacturer) && !isOther(header.serialNumber, address.serialNumber))
    {
        return std::nullopt;
    }
    return Core::Error{
        make_error_code(EVda5050Error::InvalidTopic),
        "serialNumber",
        address.manufacturer + "/" + address.serialNumber,
        std::string(CutForeignText(header.manufacturer + "/" + header.serialNumber))};
}

std::string BuildTopicPrefix(const VehicleAddress& address)
{
    assert(IsValidAddress(address));
    std::string text = address.interfaceName;
    for (const std::string_view level :
         {MAJOR_VERSION, std::string_view(address.manufacturer), std::string_view(address.serialNumber)})
    {
        text += '/';
        text += level;
    }
    return text;
}

std::string BuildTopic(const VehicleAddress& address, ETopic topic)
{
    std::string text = BuildTopicPrefix(address);
    text += '/';
    text += GetTopicName(topic);
    return text;
}

std::string BuildTopicFilter(std::string_view interfaceName, ETopic topic)
{
    std::string text(interfaceName);
    text += '/';
    text += MAJOR_VERSION;
    text += "/+/+/";
    text += GetTopicName(topic);
    return text;
}

Core::Result<ParsedTopic> ParseTopic(std::string_view text)
{
    constexpr std::string_view EXPECTED = "interfaceName/v2/manufacturer/serialNumber/topic";
    const auto fail = [text, EXPECTED](EVda5050Error error) {
        return Core::Fail(error, {}, std::string(EXPECTED), std::string(text));
    };
    std::array<std::string_view, LEVEL_COUNT> levels;
    std::size_t begin = 0;
    for (std::size_t index = 0; index < LEVEL_COUNT; ++index)
    {
        const bool bLast = index + 1 == LEVEL_COUNT;
        const std::size_t end = bLast ? text.size() : text.find('/', begin);
        if (end == std::string_view::npos)
        {
            return fail(EVda5050Error::InvalidTopic);
        }
        levels.at(index) = text.substr(begin, end - begin);
        begin = end + 1;
        if (!IsValidLevel(levels.at(index)))
        {
            return fail(EVda5050Error::InvalidTopic);
        }
    }
    const auto* const rule = std::ranges::find(RULES, levels[4], &TopicRule::name);
    if (rule == RULES.end())
    {
        return fail(EVda5050Error::InvalidTopic);
    }
    if (levels[1] != MAJOR_VERSION)
    {
        return fail(EVda5050Error::UnsupportedVersion);
    }
    return ParsedTopic{
        VehicleAddress{std::string(levels[0]), std::string(levels[2]), std::string(levels[3])},
        rule->topic};
}

} // namespace ACS::VDA5050
