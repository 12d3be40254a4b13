#pragma once

#include "TraceFolder.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/protocol_beast/EWireDirection.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// One message of a link, as it was on the wire.
struct TraceEntry
{
    std::string_view link; ///< "mcs", "mqtt", "arm"
    ProtocolBeast::EWireDirection direction = ProtocolBeast::EWireDirection::In;
    std::string_view robotID; ///< Empty: of no robot, or of one that is not ours.
    std::string_view topic;   ///< Of MQTT; else empty.
    std::string_view text;    ///< Any bytes.
};

/// The entry as one line of JSON, without its end. Text that is no UTF-8 is kept with \xNN for each byte that is not and a
/// doubled backslash, and says so ("escaped":true).
[[nodiscard]] std::string MakeTraceLine(const TraceEntry& entry, Core::Now now);

/// Writes every message of every link into files, by a thread of its own: the caller never waits for the disk. What the
/// thread cannot keep up with, and what a full disk does not take, is lost and counted, in the trace as well. Called on one
/// thread, the executor's.
class MessageTrace final
{
    struct Impl;
    std::unique_ptr<Impl> _impl;

    explicit MessageTrace(std::unique_ptr<Impl> impl);

public:
    static constexpr std::size_t DEFAULT_QUEUE_BYTES = 32U * 1024U * 1024U;

    /// Begins a file in the folder, which is made where it is not there. The error is a sentence. Clock and the log's sink
    /// outlive the trace.
    [[nodiscard]] static Core::Result<std::unique_ptr<MessageTrace>> Create(
        const std::string& folder,
        const TraceLimits& limits,
        const Core::IClock& clock,
        Core::Logger logger,
        std::size_t maximumQueuedBytes = DEFAULT_QUEUE_BYTES);

    MessageTrace(const MessageTrace&) = delete;
    MessageTrace& operator=(const MessageTrace&) = delete;

    /// Waits until what was taken is written.
    ~MessageTrace();

    void Write(const TraceEntry& entry);

    /// From the next file on.
    void SetLimits(const TraceLimits& limits);

    /// Messages that are in no file and will not be.
    [[nodiscard]] std::uint64_t GetLost() const;
};

} // namespace ACS::Acsd
