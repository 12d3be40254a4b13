#include "replay/TimerText.hpp"

#include <acs/core/ECoreError.hpp>
#include <acs/json/TextCodec.hpp>

#include <fmt/format.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <variant>

namespace ACS::Acsd
{

namespace
{

struct TimerRecord
{
    std::string timer;
    std::optional<std::int64_t> due; ///< Microseconds of the clock of `mono_us`.
};

constexpr std::string_view OWN = "acsd.";

/// In the order of EAcsdTimer.
constexpr std::array<std::string_view, 7>
    OWN_NAMES{"WorkGrace", "Drain", "Settle", "Stop", "Status", "StoreLate", "StoreCheck"};

/// In the order of EEngineTimer.
constexpr std::array<std::string_view, 15> ENGINE_NAMES{
    "Dispatch",
    "StoreRetry",
    "Acknowledged",
    "DriveExtension",
    "ControlConfirm",
    "JobTimeout",
    "HomeRetry",
    "Startup",
    "ChargeRetry",
    "JobEnd",
    "DriveStall",
    "RejectionRetry",
    "DriveWait",
    "LoadAlarm",
    "AlarmQuiet"};

template <std::size_t COUNT, typename TTimer>
std::string_view GetName(const std::array<std::string_view, COUNT>& names, TTimer timer)
{
    const auto index = static_cast<std::size_t>(timer);
    return index < COUNT ? names[index] : std::string_view("unknown");
}

template <std::size_t COUNT>
std::size_t FindIndex(const std::array<std::string_view, COUNT>& names, std::string_view name)
{
    std::size_t index = 0;
    while (index < COUNT && names[index] != name)
    {
        ++index;
    }
    return index;
}

std::string GetTimerName(const AcsdTimer& timer)
{
    if (const auto* const ownOrNull = std::get_if<EAcsdTimer>(&timer))
    {
        return fmt::format("{}{}", OWN, GetName(OWN_NAMES, *ownOrNull));
    }
    return std::string(GetName(ENGINE_NAMES, std::get<Planning::EngineTimer>(timer).kind));
}

Core::Result<AcsdTimer> FindTimer(std::string_view name, const std::string& robotID)
{
    if (name.starts_with(OWN))
    {
        const std::size_t index = FindIndex(OWN_NAMES, name.substr(OWN.size()));
        if (index < OWN_NAMES.size())
        {
            return static_cast<EAcsdTimer>(index);
        }
    }
    else if (const std::size_t index = FindIndex(ENGINE_NAMES, name); index < ENGINE_NAMES.size())
    {
        return Planning::EngineTimer{static_cast<Planning::EEngineTimer>(index), robotID};
    }
    return Core::Fail(Core::ECoreError::UnknownWord, "timer", "the name of a timer", Core::QuoteForError(name));
}

} // namespace

} // namespace ACS::Acsd

namespace ACS::Json
{

template <>
struct JsonFields<Acsd::TimerRecord>
{
    static constexpr auto FIELDS =
        std::make_tuple(Required("timer", &Acsd::TimerRecord::timer), Nullable("due", &Acsd::TimerRecord::due));
};

} // namespace ACS::Json

namespace ACS::Acsd
{

std::string DescribeTimer(const AcsdTimer& timer)
{
    const auto* const ofEngineOrNull = std::get_if<Planning::EngineTimer>(&timer);
    const bool bOfRobot = ofEngineOrNull != nullptr && !ofEngineOrNull->robotID.empty();
    return bOfRobot ? fmt::format("{} {}", GetTimerName(timer), ofEngineOrNull->robotID) : GetTimerName(timer);
}

std::string EncodeTimer(const AcsdTimer& timer, std::optional<Core::SteadyTime> dueOrNull)
{
    TimerRecord record{GetTimerName(timer), std::nullopt};
    if (dueOrNull.has_value())
    {
        record.due = std::chrono::floor<std::chrono::microseconds>(dueOrNull->time_since_epoch()).count();
    }
    return Json::EncodeText(record);
}

Core::Result<AcsdTimer> DecodeTimer(std::string_view text, const std::string& robotID)
{
    return Json::DecodeText<TimerRecord>(text).and_then(
        [&robotID](const TimerRecord& read) { return FindTimer(read.timer, robotID); });
}

} // namespace ACS::Acsd
