#include "TraceFile.hpp"

#include <acs/core/JsonText.hpp>
#include <acs/core/Timestamp.hpp>
#include <acs/json/JsonDocument.hpp>

#include <fmt/format.h>

#include <cerrno>
#include <system_error>
#include <utility>

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
    std::ofstream file,
    std::string path,
    const Core::IClock& clock,
    std::chrono::minutes offset,
    const Core::Logger& logger)
    : _file(std::move(file)),
      _path(std::move(path)),
      _clock(clock),
      _offset(offset),
      _logger(logger)
{
}

tl::expected<std::unique_ptr<TraceFile>, std::string> TraceFile::Create(
    const std::string& path,
    const Core::IClock& clock,
    std::chrono::minutes offset,
    const Core::Logger& logger)
{
    errno = 0;
    std::ofstream file(path, std::ios::binary | std::ios::trunc);
    if (!file)
    {
        const std::string reason = std::generic_category().message(errno != 0 ? errno : EIO);
        return tl::make_unexpected("the trace file " + path + " cannot be written: " + reason);
    }
    // The constructor is private.
    return std::unique_ptr<TraceFile>(new TraceFile(std::move(file), path, clock, offset, logger));
}

void TraceFile::Write(ProtocolBeast::EWireDirection direction, Protocol::ConnectionID connection, std::string_view text)
{
    if (_bBroken)
    {
        return;
    }
    _file << MakeTraceLine(_clock.GetNow().wall, _offset, direction, connection, text) << std::endl;
    if (!_file)
    {
        _bBroken = true;
        _logger.Warning("the trace file cannot be written any more: is the disk full?", {{"file", _path}});
    }
}

bool TraceFile::IsComplete() const noexcept
{
    return !_bBroken;
}

} // namespace ACS::McsSim
