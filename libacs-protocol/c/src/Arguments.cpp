#include "Arguments.hpp"

#include <acs/core/JsonText.hpp>

namespace ACS::CInterface
{

namespace
{

constexpr std::uint32_t MAXIMUM_DEPTH = 1024;
constexpr std::int32_t LAST_OFFSET_MINUTE = 24 * 60 - 1;

} // namespace

void Arguments::Add(std::int32_t result)
{
    _result = _result == ACS_OK ? result : _result;
}

void Arguments::NeedPointer(const void* pointerOrNull)
{
    Add(pointerOrNull == nullptr ? ACS_ERROR_ARGUMENT : ACS_OK);
}

std::string_view Arguments::ReadBytes(const char* textOrNull, std::size_t length)
{
    NeedPointer(textOrNull);
    return textOrNull == nullptr ? std::string_view() : std::string_view(textOrNull, length);
}

std::string_view Arguments::ReadText(const char* textOrNull, std::size_t length)
{
    const std::string_view text = ReadBytes(textOrNull, length);
    if (text.size() > ACS_MAX_NOTE_BYTES)
    {
        Add(ACS_ERROR_ARGUMENT);
        return {};
    }
    const bool bUtf8 = Core::JsonText::IsUtf8(text);
    Add(bUtf8 ? ACS_OK : ACS_ERROR_UTF8);
    return bUtf8 ? text : std::string_view();
}

std::uint64_t Arguments::ReadCount(std::uint64_t value, std::uint64_t minimum, std::uint64_t maximum)
{
    const bool bValid = value >= minimum && value <= maximum;
    Add(bValid ? ACS_OK : ACS_ERROR_ARGUMENT);
    return bValid ? value : minimum;
}

std::chrono::milliseconds Arguments::ReadDuration(std::int64_t milliseconds, std::int64_t minimum)
{
    const bool bValid = milliseconds >= minimum && milliseconds <= ACS_DURATION_MAX_MS;
    Add(bValid ? ACS_OK : ACS_ERROR_ARGUMENT);
    return std::chrono::milliseconds(bValid ? milliseconds : minimum);
}

std::chrono::minutes Arguments::ReadOffset(std::int32_t minutes)
{
    const bool bValid = minutes >= -LAST_OFFSET_MINUTE && minutes <= LAST_OFFSET_MINUTE;
    Add(bValid ? ACS_OK : ACS_ERROR_ARGUMENT);
    return std::chrono::minutes(bValid ? minutes : 0);
}

Core::WallTime Arguments::ReadWallTime(std::int64_t milliseconds)
{
    const bool bValid = milliseconds >= 0 && milliseconds <= ACS_TIME_MAX_MS;
    Add(bValid ? ACS_OK : ACS_ERROR_ARGUMENT);
    return Core::WallTime(std::chrono::milliseconds(bValid ? milliseconds : 0));
}

Core::SteadyTime Arguments::ReadSteadyTime(std::int64_t milliseconds)
{
    const bool bValid = milliseconds >= 0 && milliseconds <= ACS_TIME_MAX_MS;
    Add(bValid ? ACS_OK : ACS_ERROR_ARGUMENT);
    return Core::SteadyTime(std::chrono::milliseconds(bValid ? milliseconds : 0));
}

Protocol::EAckResult Arguments::ReadAckResult(std::int32_t value)
{
    Add(value == ACS_RESULT_SUCCESS || value == ACS_RESULT_FAIL ? ACS_OK : ACS_ERROR_ARGUMENT);
    return value == ACS_RESULT_SUCCESS ? Protocol::EAckResult::Success : Protocol::EAckResult::Fail;
}

Protocol::ESessionTimer Arguments::ReadTimer(std::int32_t value)
{
    const bool bValid = value >= 0 && value < static_cast<std::int32_t>(Protocol::TIMER_COUNT);
    Add(bValid ? ACS_OK : ACS_ERROR_ARGUMENT);
    return static_cast<Protocol::ESessionTimer>(bValid ? value : 0);
}

Protocol::CodecOptions Arguments::ReadCodecOptions(const acs_codec_options& options)
{
    Add(CheckStruct(&options));
    if (!IsValid())
    {
        return {};
    }
    Protocol::CodecOptions result;
    result.siteOffset = ReadOffset(options.site_offset_minutes);
    result.maximumBytes = ReadCount(options.max_bytes, 1, ACS_SIZE_MAX);
    result.maximumString = ReadCount(options.max_string, 1, ACS_SIZE_MAX);
    result.maximumDepth = ReadCount(options.max_depth, 1, MAXIMUM_DEPTH);
    result.maximumArray = ReadCount(options.max_array, 1, ACS_COUNT_MAX);
    result.bUnknownMembersRefused = options.refuse_unknown_members != 0;
    result.bLegacyNames = options.accept_legacy_names != 0;
    result.bLenientJSON = options.accept_lenient_json != 0;
    result.bLocationsChecked = options.check_locations != 0;
    Add(options.reserved == 0 ? ACS_OK : ACS_ERROR_ARGUMENT);
    return result;
}

bool Arguments::IsValid() const noexcept
{
    return _result == ACS_OK;
}

std::int32_t Arguments::GetResult() const noexcept
{
    return _result;
}

void WriteCodecDefaults(acs_codec_options& options)
{
    const Protocol::CodecOptions defaults;
    options = {};
    options.struct_size = sizeof(options);
    options.site_offset_minutes = static_cast<std::int32_t>(defaults.siteOffset.count());
    options.max_bytes = defaults.maximumBytes;
    options.max_string = defaults.maximumString;
    options.max_depth = static_cast<std::uint32_t>(defaults.maximumDepth);
    options.max_array = static_cast<std::uint32_t>(defaults.maximumArray);
    options.refuse_unknown_members = defaults.bUnknownMembersRefused ? 1 : 0;
    options.accept_legacy_names = defaults.bLegacyNames ? 1 : 0;
    options.accept_lenient_json = defaults.bLenientJSON ? 1 : 0;
    options.check_locations = defaults.bLocationsChecked ? 1 : 0;
}

acs_text ShowText(std::string_view text)
{
    return {text.data() == nullptr ? "" : text.data(), text.size()};
}

} // namespace ACS::CInterface
