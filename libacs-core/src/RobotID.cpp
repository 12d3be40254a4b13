#include "Element.hpp"
#include <acs/core/RobotID.hpp>

#include <algorithm>
#include <utility>

namespace ACS::Core
{

namespace
{

bool IsNameCharacter(char character)
{
    return (character >= 'A' && character <= 'Z') || (character >= 'a' && character <= 'z')
        || (character >= '0' && character <= '9') || character == '_' || character == '-';
}

bool IsName(std::string_view text)
{
    return !text.empty() && text.size() <= RobotID::MAX_LENGTH && std::ranges::all_of(text, IsNameCharacter);
}

} // namespace

RobotID::RobotID(std::string text)
    : _text(std::move(text))
{
}

bool RobotID::IsRobotID(std::string_view text) noexcept
{
    return IsName(text) && !Detail::SplitElementOrNull(text).has_value();
}

Result<RobotID> RobotID::Parse(std::string_view text)
{
    if (!IsName(text))
    {
        return Fail(
            ECoreError::InvalidIdentifier,
            {},
            "a robot's name of 1 to 64 letters, digits, _ or -",
            QuoteForError(text));
    }
    if (Detail::SplitElementOrNull(text).has_value())
    {
        return Fail(
            ECoreError::InvalidIdentifier,
            {},
            "a robot's name that does not read as an element of a location",
            QuoteForError(text));
    }
    return RobotID(std::string(text));
}

const std::string& RobotID::GetText() const noexcept
{
    return _text;
}

bool RobotID::IsAlias() const noexcept
{
    return _text == ALIAS;
}

} // namespace ACS::Core
