#include "config/PlaceConfig.hpp"

#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <string_view>

namespace ACS::Acsd
{

std::vector<Core::Location> ReadPlaces(
    const Apps::ConfigSection& section,
    const std::string& key,
    const std::string& prefix)
{
    std::vector<Core::Location> places;
    std::string errors;
    for (const std::string& text : section.GetStringList(key))
    {
        Core::Result<std::vector<Core::Location>> range = Core::ParseLocationRange(prefix + text);
        if (!range)
        {
            const std::string_view joint = errors.empty() ? "" : "; ";
            errors += fmt::format("{}\"{}\": {}", joint, text, Core::Describe(range.error()));
            continue;
        }
        std::ranges::move(*range, std::back_inserter(places));
    }
    if (!errors.empty())
    {
        section.AddError(key, errors);
    }
    return places;
}

} // namespace ACS::Acsd
