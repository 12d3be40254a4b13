#pragma once

#include "common/trace/TraceWriter.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/protocol_beast/ServerOptions.hpp>

#include <tl/expected.hpp>

#include <memory>
#include <string>
#include <string_view>

namespace ACS::McsSim
{

/// One message as a line of a trace, without its end, with the number of its connection. "in" is from the ACS.
[[nodiscard]] std::string MakeTraceLine(
    Core::Now now,
    ProtocolBeast::EWireDirection direction,
    Protocol::ConnectionID connection,
    std::string_view text);

/// Writes every message of a run to a file (NDJSON), without waiting for the disk.
class TraceFile
{
    Apps::TraceWriter _writer;
    const Core::IClock& _clock;

    TraceFile(const std::string& path, const Core::IClock& clock, const Core::Logger& logger);

public:
    /// Replaces an existing file. The error is one sentence. Clock and log sink outlive the trace.
    [[nodiscard]] static tl::expected<std::unique_ptr<TraceFile>, std::string> Create(
        const std::string& path,
        const Core::IClock& clock,
        const Core::Logger& logger);

    void Write(ProtocolBeast::EWireDirection direction, Protocol::ConnectionID connection, std::string_view text);

    /// Ends the trace. False: messages are missing in the file.
    [[nodiscard]] bool TryClose();
};

} // namespace ACS::McsSim
