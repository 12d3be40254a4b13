#include "Arguments.hpp"
#include "Guard.hpp"
#include "HandleRandom.hpp"
#include "ShownMessage.hpp"
#include <acs/c/acs_protocol.h>
#include <acs/core/JsonText.hpp>
#include <acs/core/Timestamp.hpp>
#include <acs/core/Uuid.hpp>
#include <acs/core/Version.hpp>
#include <acs/protocol/AcsCodec.hpp>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

// NOLINTBEGIN(readability-identifier-naming): the names of a C interface

struct acs_codec
{
    ACS::CInterface::HandleRandom random{nullptr, nullptr};
    std::chrono::minutes siteOffset;
    ACS::Protocol::AcsCodec codec;
    ACS::CInterface::ShownMessage shown;

    explicit acs_codec(const ACS::Protocol::CodecOptions& options)
        : siteOffset(options.siteOffset),
          codec(options)
    {
    }
};

namespace ACS::CInterface
{

namespace
{

/// The members that requests and Acks begin with.
std::string BeginMessage(
    const acs_codec& codec,
    std::string_view command,
    std::string_view suffix,
    std::string_view transactionID,
    Core::WallTime wall)
{
    std::string text = R"({"command":)";
    Core::JsonText::AppendString(std::string(command).append(suffix), text);
    text += R"(,"transactionId":)";
    Core::JsonText::AppendString(transactionID, text);
    text += R"(,"timestamp":)";
    Core::JsonText::AppendString(Core::FormatLocal(wall, codec.siteOffset), text);
    return text;
}

/// A payload that ends early and adds members of the envelope repeats a member, which the codec refuses.
std::int32_t FinishMessage(
    acs_codec& codec,
    std::string& text,
    std::string_view payload,
    bool bAck,
    acs_message& message)
{
    text += R"(,"payload":)";
    text += payload;
    text += '}';
    const Protocol::DecodeOutcome outcome = codec.codec.Decode(text);
    const std::int32_t result = codec.shown.Assign(outcome);
    codec.shown.Show(message);
    if (result == ACS_OK && std::holds_alternative<Protocol::AcsAck>(*outcome.message) != bAck)
    {
        return ACS_ERROR_DIRECTION;
    }
    return result;
}

std::int32_t DescribeResult(std::int32_t result, acs_text& text)
{
    constexpr std::array<std::string_view, ACS_ERROR_UTF8 + 1> TEXTS{
        "OK",
        "A null pointer, or a number out of range.",
        "Another ABI version or struct_size than that of the library.",
        "Out of memory.",
        "A defect of the library.",
        "An earlier call has broken this session.",
        "Not a valid message.",
        "A valid message that this function does not send.",
        "Not registered, the window is full, too many requests are pending, or plans are withheld.",
        "The request waits for no answer.",
        "Too many actions wait.",
        "Not valid UTF-8."};
    const auto index = static_cast<std::size_t>(result);
    text = ShowText(index < TEXTS.size() ? TEXTS[index] : std::string_view("Unknown result."));
    return ACS_OK;
}

} // namespace

} // namespace ACS::CInterface

using ACS::CInterface::Arguments;
using ACS::CInterface::CheckStruct;
using ACS::CInterface::Guard;

extern "C"
{
    std::int32_t acs_c_abi_version(std::uint32_t* versionOrNull)
    {
        if (versionOrNull == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        *versionOrNull = ACS_C_ABI_VERSION;
        return ACS_OK;
    }

    std::int32_t acs_c_version(acs_text* version)
    {
        if (version == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        *version = ACS::CInterface::ShowText(ACS::Core::SDK_VERSION);
        return ACS_OK;
    }

    std::int32_t acs_c_describe(std::int32_t result, acs_text* text)
    {
        return text == nullptr ? ACS_ERROR_ARGUMENT : ACS::CInterface::DescribeResult(result, *text);
    }

    std::int32_t acs_codec_options_init(acs_codec_options* options, std::size_t options_size)
    {
        return ACS::CInterface::InitOptions(options, options_size, ACS::CInterface::WriteCodecDefaults);
    }

    std::int32_t acs_codec_create(std::uint32_t abi_version, const acs_codec_options* options, acs_codec** codec)
    {
        if (codec == nullptr)
        {
            return ACS_ERROR_ARGUMENT;
        }
        *codec = nullptr;
        if (abi_version != ACS_C_ABI_VERSION)
        {
            return ACS_ERROR_VERSION;
        }
        return Guard([&]() -> std::int32_t {
            Arguments arguments;
            ACS::Protocol::CodecOptions codecOptions;
            if (options != nullptr)
            {
                codecOptions = arguments.ReadCodecOptions(*options);
            }
            if (arguments.IsValid())
            {
                *codec = std::make_unique<acs_codec>(codecOptions).release();
            }
            return arguments.GetResult();
        });
    }

    void acs_codec_destroy(acs_codec* codec)
    {
        const std::unique_ptr<acs_codec> ended(codec);
    }

    std::int32_t acs_codec_decode(acs_codec* codec, const char* text, std::size_t length, acs_message* message)
    {
        return Guard([&]() -> std::int32_t {
            Arguments arguments;
            arguments.NeedPointer(codec);
            arguments.Add(CheckStruct(message));
            const std::string_view bytes = arguments.ReadBytes(text, length);
            if (!arguments.IsValid())
            {
                return arguments.GetResult();
            }
            const std::int32_t result = codec->shown.Assign(codec->codec.Decode(bytes));
            codec->shown.Show(*message);
            return result;
        });
    }

    std::int32_t acs_codec_make_request(
        acs_codec* codec,
        const char* command,
        std::size_t command_length,
        const char* payload,
        std::size_t payload_length,
        std::int64_t wall_ms,
        acs_message* message)
    {
        return Guard([&]() -> std::int32_t {
            Arguments arguments;
            arguments.NeedPointer(codec);
            arguments.Add(CheckStruct(message));
            const std::string_view commandText = arguments.ReadText(command, command_length);
            const std::string_view payloadText = arguments.ReadBytes(payload, payload_length);
            const ACS::Core::WallTime wall = arguments.ReadWallTime(wall_ms);
            if (!arguments.IsValid())
            {
                return arguments.GetResult();
            }
            const std::string transactionID = ACS::Core::MakeUUID(codec->random);
            std::string text = ACS::CInterface::BeginMessage(*codec, commandText, {}, transactionID, wall);
            return ACS::CInterface::FinishMessage(*codec, text, payloadText, false, *message);
        });
    }

    std::int32_t acs_codec_make_ack(
        acs_codec* codec,
        const char* command,
        std::size_t command_length,
        const char* transaction_id,
        std::size_t transaction_id_length,
        std::int32_t result,
        const char* text,
        std::size_t text_length,
        const char* payload,
        std::size_t payload_length,
        std::int64_t wall_ms,
        acs_message* message)
    {
        return Guard([&]() -> std::int32_t {
            Arguments arguments;
            arguments.NeedPointer(codec);
            arguments.Add(CheckStruct(message));
            const std::string_view commandText = arguments.ReadText(command, command_length);
            const std::string_view transactionID = arguments.ReadText(transaction_id, transaction_id_length);
            const ACS::Protocol::EAckResult ackResult = arguments.ReadAckResult(result);
            const std::string_view note = arguments.ReadText(text, text_length);
            const std::string_view payloadText =
                payload == nullptr && payload_length == 0 ? "{}" : arguments.ReadBytes(payload, payload_length);
            const ACS::Core::WallTime wall = arguments.ReadWallTime(wall_ms);
            if (!arguments.IsValid())
            {
                return arguments.GetResult();
            }
            std::string made = ACS::CInterface::BeginMessage(*codec, commandText, "Ack", transactionID, wall);
            made += R"(,"result":)";
            ACS::Core::JsonText::AppendString(ACS::Protocol::GetText(ackResult), made);
            made += R"(,"message":)";
            ACS::Core::JsonText::AppendString(note, made);
            return ACS::CInterface::FinishMessage(*codec, made, payloadText, true, *message);
        });
    }

} // extern "C"

// NOLINTEND(readability-identifier-naming)
