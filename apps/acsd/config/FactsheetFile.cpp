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

std::vector<std::string> CheckFactsheetFile(const RobotLinkConfig& robot)
{
    if (!robot.factsheet.has_value())
    {
        return {};
    }
    std::vector<std::string> warnings;
    const auto add = [&robot, &warnings](std::string_view text) {
        warnings.push_back(fmt::format("robots.{}.factsheet_file: {}", robot.robotID, text));
    };
    const VDA5050::Header& header = robot.factsheet->header;
    if (!header.manufacturer.empty() && header.manufacturer != robot.manufacturer)
    {
        add(fmt::format(
            "the manufacturer is {}, and {} in the configuration; give the factsheet of this vehicle",
            Core::QuoteForError(header.manufacturer),
            robot.manufacturer));
    }
    if (!header.version.empty()
        && VDA5050::ReadVersionOrNull(header.version) != VDA5050::ReadVersionOrNull(robot.protocolVersion))
    {
        add(fmt::format(
            "the version is {}, and protocol is {}; correct protocol, or give the factsheet of this vehicle",
            Core::QuoteForError(header.version),
            robot.protocolVersion));
    }
    for (const std::string& contradiction : VDA5050::FindContradictions(*robot.factsheet))
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
