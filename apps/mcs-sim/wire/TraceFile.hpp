#pragma once

#include "common/trace/TraceWriter.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/protocol_beast/ServerOptions.hpp>

#include <tl/expected.hpp>

#include <chrono>
#include <memory>
#include <string>
#include <string_view>

namespace ACS::McsSim
{

/// One message as a line of JSON without its end: time (local, with offset), direction ("in": from the ACS), connection,
/// and message: as it was where that is JSON, else a string.
[[nodiscard]] std::string MakeTraceLine(
    Core::WallTime wall,
    std::chrono::minutes offset,
    ProtocolBeast::EWireDirection direction,
    Protocol::ConnectionID connection,
    std::string_view text);

/// Writes every message of a run to a file (NDJSON), without waiting for the disk.
class TraceFile
{
    Apps::TraceWriter _writer;
    const Core::IClock& _clock;
    std::chrono::minutes _offset;

    TraceFile(
        const std::string& path,
        const Core::IClock& clock,
        std::chrono::minutes offset,
        const Core::Logger& logger);

public:
    /// Replaces an existing file. The error is one sentence. Clock and log sink outlive the trace.
    [[nodiscard]] static tl::expected<std::unique_ptr<TraceFile>, std::string> Create(
        const std::string& path,
        const Core::IClock& clock,
        std::chrono::minutes offset,
        const Core::Logger& logger);

    void Write(ProtocolBeast::EWireDirection direction, Protocol::ConnectionID connection, std::string_view text);

    /// Ends the trace. False: messages are missing in the file.
    [[nodiscard]] bool TryClose();
};

} // namespace ACS::McsSim
