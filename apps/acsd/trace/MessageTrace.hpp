#pragma once

#include "common/trace/NewestLines.hpp"
#include "common/trace/TraceQuery.hpp"
#include "common/trace/TraceWriter.hpp"
#include <acs/core/Logger.hpp>
#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/protocol_beast/EWireDirection.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// One message of a link as it was on the wire, or an input, a decision or an output of acsd.
struct TraceEntry
{
    std::string_view link; ///< "mcs", "mqtt", "arm", "core", "store", …
    ProtocolBeast::EWireDirection direction = ProtocolBeast::EWireDirection::In;
    std::string_view robotID; ///< Empty: of no robot, or of one that is not ours.
    std::string_view topic;   ///< Of MQTT; else empty.
    std::string_view text;    ///< Any bytes.
    std::string_view kind{};  ///< Empty: a message.
    std::string_view planID{};
    std::string_view transactionID{};
    std::size_t depth = 0; ///< Of an input that came within another one.
};

/// The entry as one line of JSON, without its end. In text that is not valid UTF-8, \xNN stands for each invalid byte, each
/// backslash is doubled, and the line has "escaped":true.
[[nodiscard]] std::string MakeTraceLine(const TraceEntry& entry, Core::Now now);

/// Which lines an entry is for.
enum class ETraceUse : std::uint8_t
{
    All,       ///< The files, and the newest lines in memory.
    FilesOnly, ///< What only a replay needs.
};

/// Writes every message of every link to a trace. Called on one thread, the executor's.
class MessageTrace final
{
public:
    using LineSearch = std::function<Apps::NewestLines()>;

private:
    const Core::IClock& _clock;
    const std::string _folder;
    std::map<std::string, std::string, std::less<>> _plans; ///< Of the robots that have one.
    Apps::NewestLines _newest;
    Apps::TraceWriter _writer;

    MessageTrace(
        const std::string& folder,
        const Apps::TraceLimits& limits,
        const Core::IClock& clock,
        Core::Logger logger,
        std::size_t maxQueuedBytes);

public:
    /// Opens a file in the folder, which is created if necessary. The error is a sentence. Clock and the logger's sink
    /// outlive the trace.
    [[nodiscard]] static Core::Result<std::unique_ptr<MessageTrace>> Create(
        const std::string& folder,
        const Apps::TraceLimits& limits,
        const Core::IClock& clock,
        Core::Logger logger,
        std::size_t maxQueuedBytes = Apps::TraceWriter::DEFAULT_QUEUE_BYTES);

    /// Call it when acsd has started: deletes the oldest files. Without this call the trace ends without a file of its own, so that
    /// starts that fail do not displace the files of earlier runs.
    void Keep();

    /// Adds a message. Of one to or from the MCS the plan, the robot and the transaction are those that its text names; of a robot
    /// the plan is its current one.
    void Write(const TraceEntry& entry);
    /// Likewise, with a time from GetNow: of a message that is sent, before anyone can receive it.
    void Write(const TraceEntry& entry, Core::Now now);
    /// Adds a line of another kind, as it is, with the present time.
    void Add(const TraceEntry& entry, ETraceUse use);
    /// Likewise, with a time that is not before that of the latest line.
    void Add(const TraceEntry& entry, Core::Now now, ETraceUse use);

    [[nodiscard]] Core::Now GetNow() const;

    /// The plan that the robot has; empty: none.
    void SetPlan(const std::string& robotID, const std::string& planID);

    /// Finds the newest lines that match, in memory and at the end of the files; at most this number. Reads the files when it is
    /// called, which may be on any thread, also after the end of the trace.
    [[nodiscard]] LineSearch MakeSearch(Apps::TraceQuery query, std::size_t maximum) const;

    /// For the next file.
    void SetLimits(const Apps::TraceLimits& limits);

    [[nodiscard]] const Apps::NewestLines& GetNewest() const noexcept;

    /// Messages that are missing in the trace.
    [[nodiscard]] std::uint64_t GetLost() const;
};

} // namespace ACS::Acsd
