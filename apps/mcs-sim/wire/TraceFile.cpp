#include "wire/TraceFile.hpp"

#include <acs/core/JsonText.hpp>
#include <acs/core/Timestamp.hpp>
#include <acs/json/JsonDocument.hpp>

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <system_error>

namespace ACS::McsSim
{

namespace
{

constexpr std::string_view BYTE_ORDER_MARK = "\xEF\xBB\xBF";

std::string MakeMessage(std::string_view text)
{
    Json::JsonDocument document;
    const Core::Result<const Json::Value*> value = document.Parse(text, {});
    if (!value.has_value() || text.starts_with(BYTE_ORDER_MARK))
    {
        std::string quoted;
        Core::JsonText::AppendString(text, quoted);
        return quoted;
    }
    // Line ends between the members would end the line of the trace.
    return text.find_first_of("\r\n") == std::string_view::npos ? std::string(text) : Json::WriteText(**value);
}

} // namespace

std::string MakeTraceLine(
    Core::WallTime wall,
    std::chrono::minutes offset,
    ProtocolBeast::EWireDirection direction,
    Protocol::ConnectionID connection,
    std::string_view text)
{
    return fmt::format(
        R"({{"time":"{}","direction":"{}","connection":{},"message":{}}})",
        Core::FormatLocal(wall, offset),
        direction == ProtocolBeast::EWireDirection::In ? "in" : "out",
        connection,
        MakeMessage(text));
}

TraceFile::TraceFile(
    const std::string& path,
    const Core::IClock& clock,
    std::chrono::minutes offset,
    const Core::Logger& logger)
    : _writer(
        {path,
         {std::numeric_limits<std::uint64_t>::max(), 0},
         [offset](std::uint64_t lost, Core::Now now) {
             return fmt::format(R"({{"time":"{}","lost":{}}})", Core::FormatLocal(now.wall, offset), lost);
         }},
        clock,
        logger),
      _clock(clock),
      _offset(offset)
{
}

tl::expected<std::unique_ptr<TraceFile>, std::string> TraceFile::Create(
    const std::string& path,
    const Core::IClock& clock,
    std::chrono::minutes offset,
    const Core::Logger& logger)
{
    // The constructor is private.
    std::unique_ptr<TraceFile> trace(new TraceFile(path, clock, offset, logger));
    if (const std::error_code error = trace->_writer.Open())
    {
        return tl::make_unexpected("the trace file " + path + " cannot be written: " + error.message());
    }
    return trace;
}

void TraceFile::Write(ProtocolBeast::EWireDirection direction, Protocol::ConnectionID connection, std::string_view text)
{
    const Core::Now now = _clock.GetNow();
    _writer.Write(MakeTraceLine(now.wall, _offset, direction, connection, text), now);
}

bool TraceFile::TryClose()
{
    _writer.Close();
    return _writer.GetLost() == 0;
}

} // namespace ACS::McsSim
