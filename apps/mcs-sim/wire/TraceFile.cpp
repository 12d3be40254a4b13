#include "wire/TraceFile.hpp"

#include "common/trace/TraceLine.hpp"
#include "McsSimOptions.hpp"

#include <cstdint>
#include <functional>
#include <limits>
#include <system_error>

namespace ACS::McsSim
{

std::string MakeTraceLine(
    Core::Now now,
    ProtocolBeast::EWireDirection direction,
    Protocol::ConnectionID connection,
    std::string_view text)
{
    Apps::TraceLine line;
    line.link = "mcs";
    line.bIn = direction == ProtocolBeast::EWireDirection::In;
    line.text = text;
    line.robotID = Apps::FindTextMember(text, "robotId");
    line.planID = Apps::FindTextMember(text, "planId");
    line.transactionID = Apps::FindTextMember(text, "transactionId");
    line.connection = connection;
    line.program = PROGRAM_NAME;
    return Apps::MakeTraceLine(line, now);
}

TraceFile::TraceFile(const std::string& path, const Core::IClock& clock, const Core::Logger& logger)
    : _writer(
        {path, {std::numeric_limits<std::uint64_t>::max(), 0}, std::bind_front(&Apps::MakeLossLine, PROGRAM_NAME)},
        clock,
        logger),
      _clock(clock)
{
}

tl::expected<std::unique_ptr<TraceFile>, std::string> TraceFile::Create(
    const std::string& path,
    const Core::IClock& clock,
    const Core::Logger& logger)
{
    // The constructor is private.
    std::unique_ptr<TraceFile> trace(new TraceFile(path, clock, logger));
    if (const std::error_code error = trace->_writer.Open())
    {
        return tl::make_unexpected("the trace file " + path + " cannot be written: " + error.message());
    }
    return trace;
}

void TraceFile::Write(ProtocolBeast::EWireDirection direction, Protocol::ConnectionID connection, std::string_view text)
{
    const Core::Now now = _clock.GetNow();
    _writer.Write(MakeTraceLine(now, direction, connection, text), now);
}

bool TraceFile::TryClose()
{
    _writer.Close();
    return _writer.GetLost() == 0;
}

} // namespace ACS::McsSim
