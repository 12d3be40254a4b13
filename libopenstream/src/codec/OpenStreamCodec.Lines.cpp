#include "CodecParts.hpp"

#include <type_traits>

namespace ACS::Json
{

using OpenStream::ControlError;
using OpenStream::DataLine;
using OpenStream::ErrorLine;
using OpenStream::HandshakeAck;
using OpenStream::StopAck;

template <>
struct JsonFields<HandshakeAck>
{
    static constexpr auto FIELDS =
        std::make_tuple(Required("ok", &HandshakeAck::bOk), Optional("version", &HandshakeAck::version));
};

template <>
struct JsonFields<DataLine>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("ts", &DataLine::ts),
        Defaulted("svc_dur_ms", &DataLine::serviceDurationMs),
        Optional("result", &DataLine::result),
        Optional("status", &DataLine::status),
        Optional("id", &DataLine::id));
};

template <>
struct JsonFields<StopAck>
{
    static constexpr auto FIELDS = std::make_tuple(Required("target", &StopAck::target));
};

template <>
struct JsonFields<ControlError>
{
    static constexpr auto FIELDS =
        std::make_tuple(Required("status", &ControlError::status), Optional("body", &ControlError::body));
};

template <>
struct JsonFields<ErrorLine>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("error", &ErrorLine::codeText),
        Optional("message", &ErrorLine::message),
        Optional("hint", &ErrorLine::hint));
};

} // namespace ACS::Json

namespace ACS::OpenStream
{

namespace
{

using Json::Value;

constexpr std::string_view KEY_TYPE = "type";
constexpr std::string_view KEY_ERROR = "error";
constexpr std::string_view TYPE_DATA_OF_EXAMPLE = "monitor_data"; // what the vendor's Python example listens for

/// The type of each kind of line that has one.
template <typename TLine>
constexpr std::string_view TYPE;
template <>
constexpr std::string_view TYPE<HandshakeAck> = "handshake_ack";
template <>
constexpr std::string_view TYPE<MonitorAck> = "monitor_ack";
template <>
constexpr std::string_view TYPE<DataLine> = "data";
template <>
constexpr std::string_view TYPE<StopAck> = "stop_ack";
template <>
constexpr std::string_view TYPE<ControlError> = "control_err";

template <typename TLine>
Core::Result<OpenStreamLine> DecodeFields(const Value& root)
{
    TLine line;
    Json::DecodeContext context(Json::DecodeOptions{false, false, false, LONGEST_LINE, LONGEST_LINE});
    if (!Json::TryDecode(root, line, {}, context))
    {
        return tl::unexpected(context.TakeError());
    }
    return OpenStreamLine(std::move(line));
}

Core::Result<OpenStreamLine> DecodeError(const Value& root)
{
    Core::Result<OpenStreamLine> line = DecodeFields<ErrorLine>(root);
    if (line.has_value())
    {
        auto& error = std::get<ErrorLine>(*line);
        error.code = GetErrorCode(error.codeText);
    }
    return line;
}

Core::Result<OpenStreamLine> DecodeTyped(std::string_view type, const Value& root)
{
    if (type == TYPE<DataLine> || type == TYPE_DATA_OF_EXAMPLE)
    {
        return DecodeFields<DataLine>(root);
    }
    if (type == TYPE<ControlError>)
    {
        return DecodeFields<ControlError>(root);
    }
    if (type == TYPE<MonitorAck>)
    {
        return OpenStreamLine(MonitorAck{});
    }
    if (type == TYPE<HandshakeAck>)
    {
        return DecodeFields<HandshakeAck>(root);
    }
    if (type == TYPE<StopAck>)
    {
        return DecodeFields<StopAck>(root);
    }
    return Core::Fail(Core::ECoreError::UnknownWord, std::string(KEY_TYPE), "a type of the Open Stream");
}

template <typename TLine>
void WriteLine(const TLine& line, Json::JsonWriter& writer)
{
    static_assert(!TYPE<TLine>.empty());
    writer.Key(KEY_TYPE);
    writer.WriteString(TYPE<TLine>);
    if constexpr (!std::is_empty_v<TLine>)
    {
        Json::EncodeMembers(line, writer);
    }
}

void WriteLine(const ErrorLine& line, Json::JsonWriter& writer)
{
    writer.Key(KEY_ERROR);
    writer.WriteString(GetErrorText(line.code));
    writer.Key("message");
    writer.WriteString(line.message);
    if (!line.hint.empty())
    {
        writer.Key("hint");
        writer.WriteString(line.hint);
    }
}

} // namespace

Core::Result<OpenStreamLine> OpenStreamCodec::DecodeLine(std::string_view line)
{
    const auto parsed = _scratch->document.Parse(line, Detail::LIMITS);
    if (!parsed.has_value())
    {
        return tl::unexpected(parsed.error());
    }
    const Value& root = **parsed;
    if (!root.IsObject())
    {
        return Core::Fail(Core::ECoreError::WrongType, {}, "an object", Json::ShortenForError(root));
    }
    const Value* error = Detail::FindMemberOrNull(root, "error");
    const Value* type = Detail::FindMemberOrNull(root, "type");
    const bool bControlError = type != nullptr && type->IsString() && Detail::GetText(*type) == TYPE<ControlError>;
    if (error != nullptr && !bControlError)
    {
        return DecodeError(root);
    }
    if (type == nullptr || !type->IsString())
    {
        return Core::Fail(Core::ECoreError::MissingField, std::string(KEY_TYPE), "a member type or error");
    }
    return DecodeTyped(Detail::GetText(*type), root);
}

void OpenStreamCodec::EncodeLine(const OpenStreamLine& line, std::string& out)
{
    const std::size_t begin = out.size();
    Json::JsonWriter writer(out);
    writer.BeginObject();
    std::visit([&writer](const auto& content) { WriteLine(content, writer); }, line);
    Detail::EndLine(begin, writer, out);
}

void OpenStreamCodec::EncodeData(
    std::int64_t ts,
    double serviceDurationMs,
    const ApiResponse& response,
    const std::optional<Core::JsonText>& idOrNull,
    std::string& out)
{
    const std::size_t begin = out.size();
    Json::JsonWriter writer(out);
    writer.BeginObject();
    writer.Key(KEY_TYPE);
    writer.WriteString(TYPE<DataLine>);
    writer.Key("ts");
    writer.WriteInteger(ts);
    writer.Key("svc_dur_ms");
    writer.WriteNumber(serviceDurationMs);
    Detail::WriteOptional("result", response.body, writer);
    if (!response.body.has_value() || !response.IsSuccess())
    {
        writer.Key("status");
        writer.WriteInteger(response.status);
    }
    Detail::WriteOptional("id", idOrNull, writer);
    Detail::EndLine(begin, writer, out);
}

} // namespace ACS::OpenStream
