#pragma once

#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/protocol_beast/ServerOptions.hpp>

#include <tl/expected.hpp>

#include <chrono>
#include <fstream>
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

/// Writes every message of a run to a file (NDJSON), each at once, so that a program that dies leaves all of them.
class TraceFile
{
    std::ofstream _file;
    std::string _path;
    const Core::IClock& _clock;
    std::chrono::minutes _offset;
    Core::Logger _logger;
    bool _bBroken = false;

    TraceFile(
        std::ofstream file,
        std::string path,
        const Core::IClock& clock,
        std::chrono::minutes offset,
        const Core::Logger& logger);

public:
    /// Replaces a file that is there. The error is one sentence. Clock and log sink outlive the trace.
    [[nodiscard]] static tl::expected<std::unique_ptr<TraceFile>, std::string> Create(
        const std::string& path,
        const Core::IClock& clock,
        std::chrono::minutes offset,
        const Core::Logger& logger);

    /// What cannot be written any more is told once, in the log; the run goes on.
    void Write(ProtocolBeast::EWireDirection direction, Protocol::ConnectionID connection, std::string_view text);

    /// Whether every message so far is in the file.
    [[nodiscard]] bool IsComplete() const noexcept;
};

} // namespace ACS::McsSim
