#include "config/FactsheetFile.hpp"

#include <acs/core/Result.hpp>
#include <acs/core/ShortText.hpp>
#include <acs/vda5050/EVda5050Version.hpp>
#include <acs/vda5050/FactsheetCheck.hpp>

#include <fmt/format.h>

#include <cstddef>
#include <string_view>

namespace ACS::Acsd
{

std::vector<std::string> CheckFactsheetFile(const VehicleConfig& vehicle)
{
    if (!vehicle.factsheet.has_value())
    {
        return {};
    }
    std::vector<std::string> warnings;
    const auto add = [&vehicle, &warnings](std::string_view text) {
        warnings.push_back(fmt::format("robots.{}.factsheet_file: {}", vehicle.robotID, text));
    };
    const VDA5050::Header& header = vehicle.factsheet->header;
    if (!header.manufacturer.empty() && header.manufacturer != vehicle.address.manufacturer)
    {
        add(fmt::format(
            "the manufacturer is {}, and {} in the configuration; give the factsheet of this vehicle",
            Core::QuoteForError(header.manufacturer),
            vehicle.address.manufacturer));
    }
    if (!header.version.empty()
        && VDA5050::ReadVersionOrNull(header.version) != VDA5050::ReadVersionOrNull(vehicle.protocolVersion))
    {
        add(fmt::format(
            "the version is {}, and protocol is {}; correct protocol, or give the factsheet of this vehicle",
            Core::QuoteForError(header.version),
            vehicle.protocolVersion));
    }
    for (const std::string& contradiction : VDA5050::FindContradictions(*vehicle.factsheet))
    {
        add(Core::ShortenText(contradiction));
    }
    if (warnings.size() > MOST_FACTSHEET_WARNINGS)
    {
        const std::size_t more = warnings.size() - (MOST_FACTSHEET_WARNINGS - 1);
        warnings.resize(MOST_FACTSHEET_WARNINGS - 1);
        add(fmt::format("{} more contradictions", more));
    }
    return warnings;
}

} // namespace ACS::Acsd
