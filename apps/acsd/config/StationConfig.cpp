#include "config/StationConfig.hpp"

#include "mcs/MessageValue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

namespace
{

using Apps::ConfigSection;

constexpr std::string_view DEFAULT_TYPE = "rack";
/// Metres: nothing at a station is higher or deeper.
constexpr double FARTHEST_HEIGHT = 1'000;

StationValues MakeValues(const Planning::SiteStation& station)
{
    StationValues values{{"type", std::string(DEFAULT_TYPE)}};
    if (station.height.has_value())
    {
        values.emplace("height", *station.height);
    }
    return values;
}

/// What a template cannot put into a message.
std::optional<std::string> FindFaultOrNull(const JobValue& value)
{
    if (const auto* const text = std::get_if<std::string>(&value))
    {
        return FindTextFaultOrNull(*text);
    }
    const auto* const number = std::get_if<double>(&value);
    return number == nullptr ? std::nullopt : FindNumberFaultOrNull(*number);
}

void CheckValues(const ConfigSection& section, const StationValues& values)
{
    for (const auto& [key, value] : values)
    {
        if (const std::optional<std::string> fault = FindFaultOrNull(value))
        {
            section.AddError(key, *fault);
        }
    }
}

/// A key that acsd does not know, for templates.
void ReadValue(const ConfigSection& section, const std::string& key, StationValues& values)
{
    section.FindValueOrNull(key)->visit([&section, &key, &values](const auto& node) {
        if constexpr (
            toml::is_string<decltype(node)> || toml::is_number<decltype(node)> || toml::is_boolean<decltype(node)>)
        {
            values.insert_or_assign(key, JobValue(node.get()));
        }
        else
        {
            section.AddError(key, "expected a string, a number or a boolean");
        }
    });
}

void ReadReach(const ConfigSection& section, const std::string& stationID, AcsdConfig& config)
{
    std::vector<std::string> reach = section.GetStringList("reach");
    const auto wrong = std::ranges::find_if(reach, [&stationID, &config](const std::string& other) {
        return other == stationID || config.site->FindStationOrNull(other) == nullptr;
    });
    if (wrong != reach.end())
    {
        section.AddError(
            "reach",
            fmt::format("expected other stations of the site map, found {}", Core::QuoteForError(*wrong)));
        return;
    }
    std::set<std::string_view> seen;
    for (const std::string& other : reach)
    {
        if (!seen.insert(other).second)
        {
            section.AddError("reach", fmt::format("{} is listed twice", other));
            return;
        }
    }
    if (!reach.empty())
    {
        config.engine.reach.insert_or_assign(stationID, std::move(reach));
    }
}

void ReadStation(const ConfigSection& section, const std::string& stationID, AcsdConfig& config, StationValues& values)
{
    values.insert_or_assign("type", section.GetString("type", std::string(DEFAULT_TYPE)));
    if (section.HasKey("height"))
    {
        values.insert_or_assign("height", section.GetNumber("height", -FARTHEST_HEIGHT, FARTHEST_HEIGHT));
    }
    if (std::optional<std::string> side = section.GetStringOrNull("side"))
    {
        values.insert_or_assign("side", std::move(*side));
    }
    ReadReach(section, stationID, config);
    static_cast<void>(section.HasKey("actions")); // read with the actions
    for (const std::string& key : section.GetNames())
    {
        if (key != "reach" && key != "actions" && !values.contains(key))
        {
            ReadValue(section, key, values);
        }
    }
    CheckValues(section, values);
}

/// TOML reads [stations.A01.CP01] as the table CP01 in A01.
std::string SuggestQuotes(const std::string& stationID, const StationTable& table)
{
    const auto longer = table.lower_bound(stationID + ".");
    return longer != table.end() && longer->first.starts_with(stationID + ".")
        ? fmt::format("; a name with dots needs quotes: [stations.\"{}\"]", longer->first)
        : std::string();
}

} // namespace

void ReadStations(const ConfigSection& root, AcsdConfig& config)
{
    const ConfigSection stations = root.GetSection("stations");
    if (!config.site.has_value())
    {
        static_cast<void>(root.FindValueOrNull("stations")); // cannot be judged without a map
        return;
    }
    StationTable table;
    for (const Planning::SiteStation& station : config.site->GetStations())
    {
        table.emplace(station.stationID, MakeValues(station));
    }
    for (const std::string& stationID : stations.GetNames())
    {
        const ConfigSection section = stations.GetSection(stationID);
        const auto values = table.find(stationID);
        if (values == table.end())
        {
            section.Refuse("expected a station of the site map" + SuggestQuotes(stationID, table));
            continue;
        }
        ReadStation(section, stationID, config, values->second);
    }
    config.stations = std::make_shared<const StationTable>(std::move(table));
}

} // namespace ACS::Acsd
