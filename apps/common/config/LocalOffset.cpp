#include "common/config/LocalOffset.hpp"

#include <acs/core/ParseNumber.hpp>

#include <ctime>
#include <string>

namespace ACS::Apps
{

namespace
{

constexpr std::string_view ALLOWED_OFFSETS = "'system', 'Z', or an offset from '-12:00' to '+14:00'";
constexpr std::size_t OFFSET_LENGTH = 6;
constexpr std::size_t COLON = 3;
constexpr std::chrono::minutes MIN_OFFSET{-12 * 60};
constexpr std::chrono::minutes MAX_OFFSET{14 * 60};
constexpr unsigned MINUTES_PER_HOUR = 60;

std::optional<std::chrono::minutes> ReadOffsetOrNull(std::string_view text)
{
    if (text.size() != OFFSET_LENGTH || (text[0] != '+' && text[0] != '-') || text[COLON] != ':')
    {
        return std::nullopt;
    }
    const std::optional<unsigned> hours = Core::ParseNumberOrNull<unsigned>(text.substr(1, 2));
    const std::optional<unsigned> minutes = Core::ParseNumberOrNull<unsigned>(text.substr(COLON + 1, 2));
    if (!hours.has_value() || !minutes.has_value() || *minutes >= MINUTES_PER_HOUR)
    {
        return std::nullopt;
    }
    const std::chrono::minutes distance = std::chrono::hours(*hours) + std::chrono::minutes(*minutes);
    const std::chrono::minutes offset = text[0] == '-' ? -distance : distance;
    if (offset < MIN_OFFSET || offset > MAX_OFFSET)
    {
        return std::nullopt;
    }
    return offset;
}

} // namespace

LocalOffset::LocalOffset(std::chrono::minutes fixed)
    : _fixedOrNull(fixed)
{
}

Core::Result<LocalOffset> LocalOffset::Parse(std::string_view text)
{
    if (text == "system")
    {
        return LocalOffset();
    }
    if (text == "Z")
    {
        return LocalOffset(std::chrono::minutes(0));
    }
    const std::optional<std::chrono::minutes> offset = ReadOffsetOrNull(text);
    if (!offset.has_value())
    {
        return Core::Fail(
            Core::ECoreError::OutOfRange,
            {},
            std::string(ALLOWED_OFFSETS),
            "'" + std::string(text) + "'");
    }
    return LocalOffset(*offset);
}

std::chrono::minutes LocalOffset::GetAt(Core::WallTime time) const
{
    if (_fixedOrNull.has_value())
    {
        return *_fixedOrNull;
    }
    const std::time_t seconds = std::chrono::system_clock::to_time_t(time);
    std::tm local{};
    if (localtime_r(&seconds, &local) == nullptr)
    {
        return std::chrono::minutes(0);
    }
    return std::chrono::duration_cast<std::chrono::minutes>(std::chrono::seconds(local.tm_gmtoff));
}

} // namespace ACS::Apps
