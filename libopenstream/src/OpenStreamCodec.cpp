#include <acs/core/Overloaded.hpp>
#include <acs/json/JsonDecoder.hpp>
#include <acs/json/JsonEncoder.hpp>
#include <acs/openstream/OpenStreamCodec.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace ACS::Json
{

using OpenStream::ControlError;
using OpenStream::DataLine;
using OpenStream::EApiMethod;
using OpenStream::EOpenStreamCommand;
using OpenStream::ErrorLine;
using OpenStream::EStopTarget;
using OpenStream::HandshakeAck;
using OpenStream::StopAck;

template <>
struct EnumWords<EOpenStreamCommand>
{
    static constexpr std::array WORDS{
        EnumWord<EOpenStreamCommand>{EOpenStreamCommand::Handshake, "HANDSHAKE"},
        EnumWord<EOpenStreamCommand>{EOpenStreamCommand::Monitor, "MONITOR"},
        EnumWord<EOpenStreamCommand>{EOpenStreamCommand::Control, "CONTROL"},
        EnumWord<EOpenStreamCommand>{EOpenStreamCommand::Stop, "STOP"}};
};

template <>
struct EnumWords<EStopTarget>
{
    static constexpr std::array WORDS{
        EnumWord<EStopTarget>{EStopTarget::Monitor, "monitor"},
        EnumWord<EStopTarget>{EStopTarget::Control, "control"},
        EnumWord<EStopTarget>{EStopTarget::Session, "session"}};
};

template <>
struct EnumWords<EApiMethod>
{
    static constexpr std::array WORDS{
        EnumWord<EApiMethod>{EApiMethod::Get, "GET"},
        EnumWord<EApiMethod>{EApiMethod::Post, "POST"},
        EnumWord<EApiMethod>{EApiMethod::Put, "PUT"},
        EnumWord<EApiMethod>{EApiMethod::Delete, "DELETE"}};
};

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

constexpr Json::ParseLimits LIMITS{LONGEST_LINE, DEEPEST_NESTING};
constexpr double INTEGER_LIMIT = 9223372036854775807.0;
constexpr unsigned char FIRST_PRINTABLE = 0x21;
constexpr unsigned char RUBOUT = 0x7F;

constexpr std::string_view KEY_TYPE = "type";
constexpr std::string_view KEY_ERROR = "error";
constexpr std::string_view TYPE_HANDSHAKE_ACK = "handshake_ack";
constexpr std::string_view TYPE_MONITOR_ACK = "monitor_ack";
constexpr std::string_view TYPE_DATA = "data";
constexpr std::string_view TYPE_DATA_OF_EXAMPLE = "monitor_data"; // what the vendor's Python example listens for
constexpr std::string_view TYPE_STOP_ACK = "stop_ack";
constexpr std::string_view TYPE_CONTROL_ERR = "control_err";

std::string_view GetText(const Value& value)
{
    return {value.GetString(), value.GetStringLength()};
}

const Value* FindMemberOrNull(const Value& object, const char* name)
{
    const auto member = object.FindMember(name);
    return member == object.MemberEnd() ? nullptr : &member->value;
}

tl::unexpected<Core::Error> Refuse(
    EOpenStreamErrorCode code,
    std::string path,
    std::string expected,
    const Value* value)
{
    return Core::Fail(
        code,
        std::move(path),
        std::move(expected),
        value == nullptr ? std::string() : Json::ShortenForError(*value));
}

/// Where a read failed; the first failure wins, so that fields are checked in their order.
struct PayloadReader
{
    const Value& payload;
    std::optional<Core::Error> error;

    void Fail(EOpenStreamErrorCode code, const char* name, std::string expected, const Value* value)
    {
        if (!error.has_value())
        {
            error = Refuse(code, fmt::format("payload.{}", name), std::move(expected), value).value();
        }
    }

    /// Whole numbers of any spelling (10, 10.0); what 64 bits cannot hold comes as the nearest number.
    void ReadInteger(const char* name, EOpenStreamErrorCode missing, EOpenStreamErrorCode invalid, std::int64_t& out)
    {
        const Value* value = FindMemberOrNull(payload, name);
        if (value == nullptr)
        {
            Fail(missing, name, "an integer", value);
        }
        else if (value->IsInt64())
        {
            out = value->GetInt64();
        }
        else if (value->IsNumber() && std::floor(value->GetDouble()) == value->GetDouble())
        {
            const double number = value->GetDouble();
            const bool bInside = std::abs(number) < INTEGER_LIMIT;
            const std::int64_t nearest =
                number < 0 ? std::numeric_limits<std::int64_t>::min() : std::numeric_limits<std::int64_t>::max();
            out = bInside ? static_cast<std::int64_t>(number) : nearest;
        }
        else
        {
            Fail(invalid, name, "an integer", value);
        }
    }

    void ReadUrl(std::string& out)
    {
        const Value* value = FindMemberOrNull(payload, "url");
        if (value == nullptr)
        {
            Fail(EOpenStreamErrorCode::MissingUrl, "url", "a path such as /project/robot/po_cur", value);
        }
        else if (!value->IsString() || !IsUrl(GetText(*value)))
        {
            Fail(EOpenStreamErrorCode::InvalidUrl, "url", "a path that begins with / and has no blanks", value);
        }
        else if (value->GetStringLength() > LONGEST_URL)
        {
            Fail(EOpenStreamErrorCode::UrlTooLong, "url", fmt::format("at most {} bytes", LONGEST_URL), nullptr);
        }
        else
        {
            out.assign(GetText(*value));
        }
    }

    void ReadMethod(bool bGet, EApiMethod& out)
    {
        const Value* value = FindMemberOrNull(payload, "method");
        const char* const expected = bGet ? "GET" : "POST, PUT or DELETE";
        if (value == nullptr)
        {
            Fail(EOpenStreamErrorCode::MissingMethod, "method", expected, value);
            return;
        }
        bool bExact = false;
        const bool bKnown = value->IsString() && Json::TryReadWord(GetText(*value), out, bExact) && bExact;
        if (!bKnown || (out == EApiMethod::Get) != bGet)
        {
            Fail(EOpenStreamErrorCode::InvalidMethod, "method", expected, value);
        }
    }

    void ReadArgs(std::optional<Core::JsonText>& out)
    {
        const Value* value = FindMemberOrNull(payload, "args");
        if (value != nullptr && !value->IsObject())
        {
            Fail(EOpenStreamErrorCode::InvalidArgs, "args", "an object", value);
        }
        else if (value != nullptr)
        {
            out = Core::JsonText::FromTrusted(Json::WriteText(*value));
        }
    }

    void ReadBody(std::optional<Core::JsonText>& out)
    {
        const Value* value = FindMemberOrNull(payload, "body");
        if (value != nullptr && !value->IsObject() && !value->IsArray())
        {
            Fail(EOpenStreamErrorCode::InvalidBody, "body", "an object or an array", value);
        }
        else if (value != nullptr)
        {
            out = Core::JsonText::FromTrusted(Json::WriteText(*value));
        }
    }

    void ReadTarget(EStopTarget& out)
    {
        const Value* value = FindMemberOrNull(payload, "target");
        bool bExact = false;
        if (value == nullptr)
        {
            Fail(EOpenStreamErrorCode::MissingTarget, "target", Json::ListWords<EStopTarget>(), value);
        }
        else if (!value->IsString() || !Json::TryReadWord(GetText(*value), out, bExact) || !bExact)
        {
            Fail(EOpenStreamErrorCode::InvalidTarget, "target", Json::ListWords<EStopTarget>(), value);
        }
    }
};

HandshakeRequest ReadHandshake(PayloadReader& reader)
{
    HandshakeRequest request;
    reader.ReadInteger(
        "major",
        EOpenStreamErrorCode::MissingMajor,
        EOpenStreamErrorCode::InvalidMajorType,
        request.major);
    if (request.major < 0)
    {
        reader.Fail(EOpenStreamErrorCode::InvalidVersion, "major", "0 or more", nullptr);
    }
    return request;
}

MonitorRequest ReadMonitor(PayloadReader& reader)
{
    MonitorRequest request;
    EApiMethod method = EApiMethod::Get;
    std::int64_t period = 0;
    reader.ReadUrl(request.url);
    reader.ReadMethod(true, method);
    reader.ReadInteger("period_ms", EOpenStreamErrorCode::MissingPeriodMs, EOpenStreamErrorCode::InvalidPeriod, period);
    reader.ReadArgs(request.args);
    request.period =
        std::chrono::milliseconds(std::clamp<std::int64_t>(period, MINIMUM_PERIOD.count(), MAXIMUM_PERIOD.count()));
    const Value* id = FindMemberOrNull(reader.payload, "id");
    if (id != nullptr && (id->IsString() || id->IsNumber()))
    {
        request.id = Core::JsonText::FromTrusted(Json::WriteText(*id));
    }
    return request;
}

ControlRequest ReadControl(PayloadReader& reader)
{
    ControlRequest request;
    reader.ReadUrl(request.url);
    reader.ReadMethod(false, request.method);
    reader.ReadArgs(request.args);
    reader.ReadBody(request.body);
    return request;
}

StopRequest ReadStop(PayloadReader& reader)
{
    StopRequest request;
    reader.ReadTarget(request.target);
    return request;
}

OpenStreamRequest ReadPayload(EOpenStreamCommand command, PayloadReader& reader)
{
    switch (command)
    {
        case EOpenStreamCommand::Handshake:
            return ReadHandshake(reader);
        case EOpenStreamCommand::Monitor:
            return ReadMonitor(reader);
        case EOpenStreamCommand::Control:
            return ReadControl(reader);
        case EOpenStreamCommand::Stop:
            return ReadStop(reader);
        default:
            assert(false && "unhandled EOpenStreamCommand");
            return StopRequest{};
    }
}

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
    if (type == TYPE_DATA || type == TYPE_DATA_OF_EXAMPLE)
    {
        return DecodeFields<DataLine>(root);
    }
    if (type == TYPE_CONTROL_ERR)
    {
        return DecodeFields<ControlError>(root);
    }
    if (type == TYPE_MONITOR_ACK)
    {
        return OpenStreamLine(MonitorAck{});
    }
    if (type == TYPE_HANDSHAKE_ACK)
    {
        return DecodeFields<HandshakeAck>(root);
    }
    if (type == TYPE_STOP_ACK)
    {
        return DecodeFields<StopAck>(root);
    }
    return Core::Fail(Core::ECoreError::UnknownWord, std::string(KEY_TYPE), "a type of the Open Stream");
}

/// JSON may hold line ends between its tokens, a line may not.
void RemoveLineEnds(std::string& out, std::size_t begin)
{
    const auto isLineEnd = [](char letter) {
        return letter == '\n' || letter == '\r';
    };
    std::replace_if(out.begin() + static_cast<std::ptrdiff_t>(begin), out.end(), isLineEnd, ' ');
}

void EndLine(std::size_t begin, Json::JsonWriter& writer, std::string& out)
{
    writer.EndObject();
    RemoveLineEnds(out, begin);
    out += '\n';
}

void WriteOptional(std::string_view name, const std::optional<Core::JsonText>& value, Json::JsonWriter& writer)
{
    if (value.has_value())
    {
        writer.Key(name);
        writer.WriteRaw(*value);
    }
}

void WritePayload(const HandshakeRequest& request, Json::JsonWriter& writer)
{
    writer.Key("major");
    writer.WriteInteger(request.major);
}

void WritePayload(const MonitorRequest& request, Json::JsonWriter& writer)
{
    writer.Key("method");
    writer.WriteString(Json::GetWord(EApiMethod::Get));
    writer.Key("url");
    writer.WriteString(request.url);
    WriteOptional("args", request.args, writer);
    WriteOptional("id", request.id, writer);
    writer.Key("period_ms");
    writer.WriteInteger(std::clamp(request.period, MINIMUM_PERIOD, MAXIMUM_PERIOD).count());
}

void WritePayload(const ControlRequest& request, Json::JsonWriter& writer)
{
    writer.Key("method");
    writer.WriteString(Json::GetWord(request.method));
    writer.Key("url");
    writer.WriteString(request.url);
    WriteOptional("args", request.args, writer);
    WriteOptional("body", request.body, writer);
}

void WritePayload(const StopRequest& request, Json::JsonWriter& writer)
{
    writer.Key("target");
    writer.WriteString(Json::GetWord(request.target));
}

template <typename TLine>
void WriteTyped(std::string_view type, const TLine& line, Json::JsonWriter& writer)
{
    writer.Key(KEY_TYPE);
    writer.WriteString(type);
    Json::EncodeMembers(line, writer);
}

void WriteLine(const HandshakeAck& line, Json::JsonWriter& writer)
{
    WriteTyped(TYPE_HANDSHAKE_ACK, line, writer);
}

void WriteLine(const MonitorAck& /*line*/, Json::JsonWriter& writer)
{
    writer.Key(KEY_TYPE);
    writer.WriteString(TYPE_MONITOR_ACK);
}

void WriteLine(const DataLine& line, Json::JsonWriter& writer)
{
    WriteTyped(TYPE_DATA, line, writer);
}

void WriteLine(const StopAck& line, Json::JsonWriter& writer)
{
    WriteTyped(TYPE_STOP_ACK, line, writer);
}

void WriteLine(const ControlError& line, Json::JsonWriter& writer)
{
    WriteTyped(TYPE_CONTROL_ERR, line, writer);
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

struct OpenStreamCodec::Scratch
{
    Json::JsonDocument document;
    const Value* requestOrNull = nullptr;
    EOpenStreamCommand command = EOpenStreamCommand::Handshake;
};

OpenStreamCodec::OpenStreamCodec()
    : _scratch(std::make_unique<Scratch>())
{
}

OpenStreamCodec::OpenStreamCodec(OpenStreamCodec&&) noexcept = default;
OpenStreamCodec& OpenStreamCodec::operator=(OpenStreamCodec&&) noexcept = default;
OpenStreamCodec::~OpenStreamCodec() = default;

Core::Result<EOpenStreamCommand> OpenStreamCodec::ReadCommand(std::string_view line)
{
    _scratch->requestOrNull = nullptr;
    const auto parsed = _scratch->document.Parse(line, LIMITS);
    if (!parsed.has_value())
    {
        Core::Error error = parsed.error();
        error.code = EOpenStreamErrorCode::InvalidNdjson;
        return tl::unexpected(std::move(error));
    }
    const Value& root = **parsed;
    if (!root.IsObject())
    {
        return Refuse(EOpenStreamErrorCode::InvalidNdjson, {}, "an object", &root);
    }
    if (Json::HasDuplicateNames(root))
    {
        return Core::Fail(EOpenStreamErrorCode::InvalidNdjson, {}, "each member once", "a member named twice");
    }
    const Value* command = FindMemberOrNull(root, "cmd");
    bool bExact = false;
    if (command == nullptr || !command->IsString() || !Json::TryReadWord(GetText(*command), _scratch->command, bExact)
        || !bExact)
    {
        return Refuse(EOpenStreamErrorCode::InvalidCmd, "cmd", Json::ListWords<EOpenStreamCommand>(), command);
    }
    _scratch->requestOrNull = &root;
    return _scratch->command;
}

Core::Result<OpenStreamRequest> OpenStreamCodec::ReadRequest()
{
    assert(_scratch->requestOrNull != nullptr && "ReadCommand goes first");
    const Value* payload = FindMemberOrNull(*_scratch->requestOrNull, "payload");
    if (payload == nullptr || !payload->IsObject())
    {
        return Refuse(EOpenStreamErrorCode::InvalidPayload, "payload", "an object", payload);
    }
    PayloadReader reader{*payload, std::nullopt};
    OpenStreamRequest request = ReadPayload(_scratch->command, reader);
    if (reader.error.has_value())
    {
        return tl::unexpected(std::move(*reader.error));
    }
    return request;
}

Core::Result<OpenStreamRequest> OpenStreamCodec::DecodeRequest(std::string_view line)
{
    const Core::Result<EOpenStreamCommand> command = ReadCommand(line);
    if (!command.has_value())
    {
        return tl::unexpected(command.error());
    }
    return ReadRequest();
}

Core::Result<OpenStreamLine> OpenStreamCodec::DecodeLine(std::string_view line)
{
    const auto parsed = _scratch->document.Parse(line, LIMITS);
    if (!parsed.has_value())
    {
        return tl::unexpected(parsed.error());
    }
    const Value& root = **parsed;
    if (!root.IsObject())
    {
        return Core::Fail(Core::ECoreError::WrongType, {}, "an object", Json::ShortenForError(root));
    }
    const Value* error = FindMemberOrNull(root, "error");
    const Value* type = FindMemberOrNull(root, "type");
    const bool bControlError = type != nullptr && type->IsString() && GetText(*type) == TYPE_CONTROL_ERR;
    if (error != nullptr && !bControlError)
    {
        return DecodeError(root);
    }
    if (type == nullptr || !type->IsString())
    {
        return Core::Fail(Core::ECoreError::MissingField, std::string(KEY_TYPE), "a member type or error");
    }
    return DecodeTyped(GetText(*type), root);
}

void OpenStreamCodec::EncodeRequest(const OpenStreamRequest& request, std::string& out)
{
    const std::size_t begin = out.size();
    Json::JsonWriter writer(out);
    writer.BeginObject();
    writer.Key("cmd");
    writer.WriteString(Json::GetWord(static_cast<EOpenStreamCommand>(request.index())));
    writer.Key("payload");
    writer.BeginObject();
    std::visit([&writer](const auto& payload) { WritePayload(payload, writer); }, request);
    writer.EndObject();
    EndLine(begin, writer, out);
}

void OpenStreamCodec::EncodeLine(const OpenStreamLine& line, std::string& out)
{
    const std::size_t begin = out.size();
    Json::JsonWriter writer(out);
    writer.BeginObject();
    std::visit([&writer](const auto& content) { WriteLine(content, writer); }, line);
    EndLine(begin, writer, out);
}

void OpenStreamCodec::EncodeData(
    std::int64_t ts,
    double serviceDurationMs,
    const ApiResponse& response,
    const std::optional<Core::JsonText>& id,
    std::string& out)
{
    const std::size_t begin = out.size();
    Json::JsonWriter writer(out);
    writer.BeginObject();
    writer.Key(KEY_TYPE);
    writer.WriteString(TYPE_DATA);
    writer.Key("ts");
    writer.WriteInteger(ts);
    writer.Key("svc_dur_ms");
    writer.WriteNumber(serviceDurationMs);
    WriteOptional("result", response.body, writer);
    if (!response.body.has_value() || !response.IsSuccess())
    {
        writer.Key("status");
        writer.WriteInteger(response.status);
    }
    WriteOptional("id", id, writer);
    EndLine(begin, writer, out);
}

bool IsUrl(std::string_view url) noexcept
{
    const auto isRefused = [](char letter) {
        const auto byte = static_cast<unsigned char>(letter);
        return byte < FIRST_PRINTABLE || byte == RUBOUT;
    };
    return url.starts_with('/') && std::ranges::none_of(url, isRefused);
}

std::string_view GetMethodText(EApiMethod method) noexcept
{
    return Json::GetWord(method);
}

} // namespace ACS::OpenStream
