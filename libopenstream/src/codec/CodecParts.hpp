#pragma once

#include <acs/json/JsonDecoder.hpp>
#include <acs/json/JsonEncoder.hpp>
#include <acs/openstream/OpenStreamCodec.hpp>

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Json
{

using OpenStream::EApiMethod;
using OpenStream::EStopTarget;

template <>
struct EnumNames<EStopTarget>
{
    static constexpr std::array WORDS{
        EnumWord<EStopTarget>{EStopTarget::Monitor, "monitor"},
        EnumWord<EStopTarget>{EStopTarget::Control, "control"},
        EnumWord<EStopTarget>{EStopTarget::Session, "session"}};
};

template <>
struct EnumNames<EApiMethod>
{
    static constexpr std::array WORDS{
        EnumWord<EApiMethod>{EApiMethod::Get, "GET"},
        EnumWord<EApiMethod>{EApiMethod::Post, "POST"},
        EnumWord<EApiMethod>{EApiMethod::Put, "PUT"},
        EnumWord<EApiMethod>{EApiMethod::Delete, "DELETE"}};
};

} // namespace ACS::Json

namespace ACS::OpenStream
{

struct OpenStreamCodec::Scratch
{
    Json::JsonDocument document;
    const Json::Value* requestOrNull = nullptr;
    EOpenStreamCommand command = EOpenStreamCommand::Handshake;
};

namespace Detail
{

/// What requests and lines of the server share.

inline constexpr Json::ParseLimits LIMITS{LONGEST_LINE, DEEPEST_NESTING};

[[nodiscard]] std::string_view GetText(const Json::Value& value);
[[nodiscard]] const Json::Value* FindMemberOrNull(const Json::Value& object, const char* name);

void WriteOptional(std::string_view name, const std::optional<Core::JsonText>& valueOrNull, Json::JsonWriter& writer);

/// Ends the object that begins there, and the line with it.
void EndLine(std::size_t begin, Json::JsonWriter& writer, std::string& out);

} // namespace Detail

} // namespace ACS::OpenStream
