#include "CodecParts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>

namespace ACS::Json
{

using OpenStream::EOpenStreamCommand;

template <>
struct EnumNames<EOpenStreamCommand>
{
    static constexpr std::array WORDS{
        EnumWord<EOpenStreamCommand>{EOpenStreamCommand::Handshake, "HANDSHAKE"},
        EnumWord<EOpenStreamCommand>{EOpenStreamCommand::Monitor, "MONITOR"},
        EnumWord<EOpenStreamCommand>{EOpenStreamCommand::Control, "CONTROL"},
        EnumWord<EOpenStreamCommand>{EOpenStreamCommand::Stop, "STOP"}};
};

} // namespace ACS::Json

namespace ACS::OpenStream
{

namespace
{

using Detail::FindMemberOrNull;
using Detail::GetText;
using Detail::WriteOptional;
using Json::Value;

constexpr double INTEGER_LIMIT = 9223372036854775807.0;

tl::unexpected<Core::Error> Refuse(
    EOpenStreamErrorCode code,
    std::string path,
    std::string expected,
    const Value* valueOrNull)
{
    return Core::Fail(
        code,
        std::move(path),
        std::move(expected),
        valueOrNull == nullptr ? std::string() : Json::ShortenForError(*valueOrNull));
}

/// Where a read failed; the first failure wins, so that fields are checked in their order.
struct PayloadReader
{
    const Value& payload;
    std::optional<Core::Error> error;

    void Fail(EOpenStreamErrorCode code, const char* name, std::string expected, const Value* valueOrNull)
    {
        if (!error.has_value())
        {
            error = Refuse(code, fmt::format("payload.{}", name), std::move(expected), valueOrNull).value();
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

    void ReadURL(std::string& out)
    {
        const Value* value = FindMemberOrNull(payload, "url");
        if (value == nullptr)
        {
            Fail(EOpenStreamErrorCode::MissingURL, "url", "a path such as /project/robot/po_cur", value);
        }
        else if (!value->IsString() || !IsURL(GetText(*value)))
        {
            Fail(EOpenStreamErrorCode::InvalidURL, "url", "a path that begins with / and has no blanks", value);
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
    reader.ReadURL(request.url);
    reader.ReadMethod(true, method);
    reader.ReadInteger("period_ms", EOpenStreamErrorCode::MissingPeriodMs, EOpenStreamErrorCode::InvalidPeriod, period);
    reader.ReadArgs(request.args);
    request.period =
        std::chrono::milliseconds(std::clamp<std::int64_t>(period, MINIMUM_PERIOD.count(), MAXIMUM_PERIOD.count()));
    const Value* id = FindMemberOrNull(reader.payload, "id");
    if (id != nullptr && (id->IsString() || id->IsNumber()))
    {
        std::string text = Json::WriteText(*id);
        if (text.size() <= LONGEST_ID)
        {
            request.id = Core::JsonText::FromTrusted(std::move(text));
        }
    }
    return request;
}

ControlRequest ReadControl(PayloadReader& reader)
{
    ControlRequest request;
    reader.ReadURL(request.url);
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

} // namespace

Core::Result<EOpenStreamCommand> OpenStreamCodec::ReadCommand(std::string_view line)
{
    _scratch->requestOrNull = nullptr;
    const auto parsed = _scratch->document.Parse(line, Detail::LIMITS);
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
    Detail::EndLine(begin, writer, out);
}

} // namespace ACS::OpenStream
