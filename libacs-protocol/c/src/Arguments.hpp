#pragma once

#include <acs/c/acs_protocol.h>
#include <acs/core/Now.hpp>
#include <acs/protocol/CodecOptions.hpp>
#include <acs/protocol/EAckResult.hpp>
#include <acs/protocol/SessionAction.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace ACS::CInterface
{

/// ACS_OK unless the pointer is null or the structure is declared otherwise by the caller.
template <typename TStruct>
[[nodiscard]] std::int32_t CheckStruct(const TStruct* valueOrNull)
{
    if (valueOrNull == nullptr)
    {
        return ACS_ERROR_ARGUMENT;
    }
    return valueOrNull->struct_size == sizeof(TStruct) ? ACS_OK : ACS_ERROR_VERSION;
}

/// Calls write(options) if the caller declares the structure as the library does.
template <typename TOptions, typename TWrite>
[[nodiscard]] std::int32_t InitOptions(TOptions* optionsOrNull, std::size_t size, TWrite write)
{
    if (optionsOrNull == nullptr)
    {
        return ACS_ERROR_ARGUMENT;
    }
    if (size != sizeof(TOptions))
    {
        return ACS_ERROR_VERSION;
    }
    write(*optionsOrNull);
    return ACS_OK;
}

/// Reads and checks the arguments of one call; the first error remains.
class Arguments
{
    std::int32_t _result = ACS_OK;

public:
    /// Notes the result unless there is an error already.
    void Add(std::int32_t result);

    void NeedPointer(const void* pointerOrNull);

    /// A text that is not a message: valid UTF-8 of at most ACS_MAX_NOTE_BYTES. Empty after an error.
    [[nodiscard]] std::string_view ReadText(const char* textOrNull, std::size_t length);

    /// Any bytes, which a codec checks.
    [[nodiscard]] std::string_view ReadBytes(const char* textOrNull, std::size_t length);

    [[nodiscard]] std::uint64_t ReadCount(std::uint64_t value, std::uint64_t minimum, std::uint64_t maximum);
    [[nodiscard]] std::chrono::milliseconds ReadDuration(std::int64_t milliseconds, std::int64_t minimum);
    [[nodiscard]] std::chrono::minutes ReadOffset(std::int32_t minutes);
    [[nodiscard]] Core::WallTime ReadWallTime(std::int64_t milliseconds);
    [[nodiscard]] Core::SteadyTime ReadSteadyTime(std::int64_t milliseconds);
    [[nodiscard]] Protocol::EAckResult ReadAckResult(std::int32_t value);
    [[nodiscard]] Protocol::ESessionTimer ReadTimer(std::int32_t value);
    [[nodiscard]] Protocol::CodecOptions ReadCodecOptions(const acs_codec_options& options);

    [[nodiscard]] bool IsValid() const noexcept;
    [[nodiscard]] std::int32_t GetResult() const noexcept;
};

/// The defaults of the C++ interface.
void WriteCodecDefaults(acs_codec_options& options);

/// The view is of a string, so that a zero byte follows it.
[[nodiscard]] acs_text ShowText(std::string_view text);

} // namespace ACS::CInterface
