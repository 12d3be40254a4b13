#include "Fields.hpp"

#include <chrono>

namespace ACS::Json
{

bool ValueDecoder<std::optional<Core::Timestamp>>::TryDecode(
    const Value& value,
    std::optional<Core::Timestamp>& out,
    const FieldBounds& /*bounds*/,
    DecodeContext& context)
{
    out = value.IsNull() ? std::nullopt
                         : Protocol::Detail::ReadTimestampOrNull(value, context.GetOptions().assumedOffset);
    context.GetNotes().badTimestamps += out.has_value() || value.IsNull() ? 0U : 1U;
    return true;
}

void ValueEncoder<Core::Timestamp>::Encode(const Core::Timestamp& value, JsonWriter& writer)
{
    const Core::LocalTimeText text = Core::PrintLocal(value.time, value.offset);
    writer.WritePlainString({text.data(), text.size()});
}

bool ValueDecoder<Protocol::EReportResult>::TryDecode(
    const Value& value,
    Protocol::EReportResult& out,
    const FieldBounds& bounds,
    DecodeContext& context)
{
    std::string_view text;
    if (!TryDecodeString(value, text, bounds, context))
    {
        return false;
    }
    const bool bSuccess =
        Protocol::Detail::IsSuccess(text, GetWord(Protocol::EReportResult::Failed), context.GetNotes());
    out = bSuccess ? Protocol::EReportResult::Success : Protocol::EReportResult::Failed;
    return true;
}

bool ValueDecoder<Protocol::SyncConfig>::TryDecode(
    const Value& value,
    Protocol::SyncConfig& out,
    const FieldBounds& bounds,
    DecodeContext& context)
{
    if (!value.IsObject())
    {
        return context.IsFailedWith(Core::ECoreError::WrongType, "an object", &value);
    }
    return ValueDecoder<Core::JsonText>::TryDecode(value, out.content, bounds, context);
}

void ValueEncoder<Protocol::SyncConfig>::Encode(const Protocol::SyncConfig& value, JsonWriter& writer)
{
    writer.WriteRaw(value.content);
}

} // namespace ACS::Json

namespace ACS::Protocol::Detail
{

bool IsSuccess(std::string_view text, std::string_view failureWord, Json::DecodeNotes& notes)
{
    const std::string_view successWord = Json::GetWord(EAckResult::Success);
    if (text == successWord)
    {
        return true;
    }
    notes.lenientWords += text == failureWord ? 0U : 1U;
    return Json::IsEqualIgnoringCase(text, successWord) || Json::IsEqualIgnoringCase(text, "ok");
}

std::optional<Core::Timestamp> ReadTimestampOrNull(const Json::Value& value, std::chrono::minutes assumedOffset)
{
    if (!value.IsString())
    {
        return std::nullopt;
    }
    const std::string_view text(value.GetString(), value.GetStringLength());
    const Core::Result<Core::Timestamp> timestamp = Core::ParseTimestamp(text, assumedOffset);
    if (!timestamp.has_value())
    {
        return std::nullopt;
    }
    return Core::Timestamp{std::chrono::floor<std::chrono::milliseconds>(timestamp->time), timestamp->offset};
}

} // namespace ACS::Protocol::Detail
