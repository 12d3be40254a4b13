#include "world/WorldNames.hpp"

#include "world/EWorldError.hpp"
#include "world/Place.hpp"
#include <acs/core/ControlCharacter.hpp>
#include <acs/core/JsonText.hpp>
#include <acs/core/RobotID.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace ACS::Sim
{

Core::Result<void> CheckName(std::string_view name)
{
    if (name.empty() || name.size() > MAX_NAME || Core::HasControlCharacter(name) || !Core::JsonText::IsUtf8(name))
    {
        return Core::Fail(
            EWorldError::InvalidName,
            {},
            fmt::format("a name of 1 to {} bytes without control characters", MAX_NAME),
            Core::QuoteForError(name));
    }
    return {};
}

Core::Result<void> CheckRobotName(std::string_view robotID)
{
    if (!Core::RobotID::IsRobotID(robotID) || robotID == Core::RobotID::ALIAS)
    {
        return Core::Fail(EWorldError::InvalidName, {}, "a robot such as LR01", Core::QuoteForError(robotID));
    }
    return {};
}

std::string MakeCanonical(std::string_view name)
{
    const Core::Result<Place> place = ParsePlace(name);
    return place.has_value() ? place->text : std::string(name);
}

} // namespace ACS::Sim
