#include "MessageTrace.hpp"

#include <acs/core/ECoreError.hpp>
#include <acs/core/JsonText.hpp>
#include <acs/core/Timestamp.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <iterator>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace ACS::Acsd
{

namespace
{

using namespace std::chrono_literals;

/// After a failure the disk is left alone for so long.
constexpr std::chrono::seconds RETRY = 10s;
/// What an entry takes besides its texts.
constexpr std::size_t ENTRY_BYTES = 160;

/// Bytes of the character that begins here; 0: none does.
std::size_t GetCharacterLength(std::string_view text)
{
    constexpr std::size_t LONGEST = 4;
    for (std::size_t length = 1; length <= std::min(LONGEST, text.size()); ++length)
    {
        if (Core::JsonText::IsUtf8(text.substr(0, length)))
        {
            return length;
        }
    }
    return 0;
}

std::string EscapeBytes(std::string_view text)
{
    std::string escaped;
    for (std::size_t at = 0; at < text.size();)
    {
        const std::size_t length = GetCharacterLength(text.substr(at));
        if (length == 0)
        {
            fmt::format_to(std::back_inserter(escaped), "\\x{:02X}", static_cast<unsigned char>(text[at]));
        }
        else
        {
            escaped.append(text[at] == '\\' ? "\\\\" : text.substr(at, length));
        }
        at += std::max<std::size_t>(length, 1);
    }
    return escaped;
}

void BeginLine(Core::Now now, std::string_view link, std::string& line)
{
    fmt::format_to(
        std::back_inserter(line),
        R"({{"time":"{}","mono_us":{},"link":"{}")",
        Core::FormatUtc(now.wall),
        std::chrono::duration_cast<std::chrono::microseconds>(now.steady.time_since_epoch()).count(),
        link);
}

void AppendMember(std::string_view name, std::string_view value, std::string& line)
{
    fmt::format_to(std::back_inserter(line), R"(,"{}":)", name);
    Core::JsonText::AppendString(value, line);
}

std::string MakeLossLine(std::uint64_t count, Core::Now now)
{
    std::string line;
    BeginLine(now, "trace", line);
    fmt::format_to(std::back_inserter(line), R"(,"lost":{}}})", count);
    return line;
}

} // namespace

std::string MakeTraceLine(const TraceEntry& entry, Core::Now now)
{
    std::string line;
    BeginLine(now, entry.link, line);
    line += entry.direction == ProtocolBeast::EWireDirection::In ? R"(,"direction":"in")" : R"(,"direction":"out")";
    if (!entry.robotID.empty())
    {
        AppendMember("robot", entry.robotID, line);
    }
    if (!entry.topic.empty())
    {
        AppendMember("topic", entry.topic, line);
    }
    if (Core::JsonText::IsUtf8(entry.text))
    {
        AppendMember("text", entry.text, line);
    }
    else
    {
        AppendMember("text", EscapeBytes(entry.text), line);
        line += R"(,"escaped":true)";
    }
    line += '}';
    return line;
}

struct MessageTrace::Impl
{
    struct Record
    {
        Core::Now now;
        std::string link;
        ProtocolBeast::EWireDirection direction = ProtocolBeast::EWireDirection::In;
        std::string robotID;
        std::string topic;
        std::string text;
        std::uint64_t lostBefore = 0; ///< Messages for which there was no room in the queue.

        [[nodiscard]] std::size_t GetSize() const
        {
            return ENTRY_BYTES + robotID.size() + topic.size() + text.size();
        }
    };

    const Core::IClock& clock;
    Core::Logger logger;
    std::string path;
    std::size_t maximumBytes;

    std::mutex mutex; ///< Of what follows.
    std::condition_variable wake;
    std::deque<Record> queue;
    std::size_t queuedBytes = 0;
    std::uint64_t untold = 0; ///< Lost, and no record says so yet.
    std::uint64_t lost = 0;
    TraceLimits limits;
    std::optional<std::string> failure; ///< To be told by the caller's thread: the log has one thread.
    bool bRecovered = false;            ///< Likewise.
    bool bStopping = false;

    // The thread's own.
    TraceFolder folder;
    std::optional<Core::SteadyTime> failedAt;
    std::uint64_t unwritten = 0; ///< Lost, which no line of the trace says yet.
    std::thread thread;

    Impl(const Core::IClock& theClock, Core::Logger theLogger, const std::string& thePath, std::size_t queueBytes)
        : clock(theClock),
          logger(std::move(theLogger)),
          path(thePath),
          maximumBytes(queueBytes),
          folder(thePath)
    {
    }

    void Run()
    {
        std::unique_lock lock(mutex);
        while (!bStopping || !queue.empty() || untold > 0)
        {
            wake.wait(lock, [this] { return bStopping || !queue.empty(); });
            std::deque<Record> records = std::exchange(queue, {});
            const std::uint64_t lostAtEnd = bStopping ? std::exchange(untold, 0) : 0;
            const TraceLimits present = limits;
            queuedBytes = 0;
            lock.unlock();
            WriteAll(records, lostAtEnd, present);
            lock.lock();
        }
    }

    void WriteAll(const std::deque<Record>& records, std::uint64_t lostAtEnd, const TraceLimits& present)
    {
        for (const Record& record : records)
        {
            unwritten += record.lostBefore;
            const bool bDiskLeftAlone = failedAt.has_value() && record.now.steady - *failedAt < RETRY;
            if (bDiskLeftAlone || !TryTellLoss(record.now, present))
            {
                CountLost(1);
                continue;
            }
            const std::string line =
                MakeTraceLine({record.link, record.direction, record.robotID, record.topic, record.text}, record.now);
            Settle(folder.Append(line, present), record.now);
        }
        const Core::Now now = records.empty() ? clock.GetNow() : records.back().now;
        unwritten += lostAtEnd;
        if (lostAtEnd > 0)
        {
            static_cast<void>(TryTellLoss(now, present));
        }
        Settle(folder.Flush(), now);
    }

    /// What was lost stands in the trace before what comes after it. False: it still cannot be written.
    [[nodiscard]] bool TryTellLoss(Core::Now now, const TraceLimits& present)
    {
        if (unwritten == 0)
        {
            return true;
        }
        // By itself, so that each lost line is a message or this one.
        std::error_code error = folder.Flush();
        Settle(error, now);
        if (error)
        {
            return false;
        }
        error = folder.Append(MakeLossLine(unwritten, now), present);
        if (!error)
        {
            error = folder.Flush();
        }
        if (error)
        {
            NoteFailure(error, now);
            return false;
        }
        unwritten = 0;
        if (failedAt.has_value())
        {
            failedAt.reset();
            const std::lock_guard lock(mutex);
            bRecovered = true;
        }
        return true;
    }

    void Settle(const std::error_code& error, Core::Now now)
    {
        if (error)
        {
            NoteFailure(error, now);
            CountLost(folder.GetLostLines());
        }
    }

    void NoteFailure(const std::error_code& error, Core::Now now)
    {
        const bool bFirst = !failedAt.has_value();
        failedAt = now.steady;
        if (bFirst)
        {
            const std::lock_guard lock(mutex);
            failure = error.message();
        }
    }

    void CountLost(std::uint64_t count)
    {
        unwritten += count;
        const std::lock_guard lock(mutex);
        lost += count;
    }
};

MessageTrace::MessageTrace(std::unique_ptr<Impl> impl)
    : _impl(std::move(impl))
{
}

MessageTrace::~MessageTrace()
{
    {
        const std::lock_guard lock(_impl->mutex);
        _impl->bStopping = true;
    }
    _impl->wake.notify_one();
    _impl->thread.join();
}

Core::Result<std::unique_ptr<MessageTrace>> MessageTrace::Create(
    const std::string& folder,
    const TraceLimits& limits,
    const Core::IClock& clock,
    Core::Logger logger,
    std::size_t maximumQueuedBytes)
{
    auto impl = std::make_unique<Impl>(clock, std::move(logger), folder, maximumQueuedBytes);
    impl->limits = limits;
    const std::error_code error = impl->folder.Open(limits);
    if (error)
    {
        return Core::Fail(error, {}, "a folder for --trace that can be written", folder + ": " + error.message());
    }
    impl->thread = std::thread([&owner = *impl] { owner.Run(); });
    return std::unique_ptr<MessageTrace>(new MessageTrace(std::move(impl))); // the constructor is private
}

void MessageTrace::Write(const TraceEntry& entry)
{
    Impl::Record record{
        _impl->clock.GetNow(),
        std::string(entry.link),
        entry.direction,
        std::string(entry.robotID),
        std::string(entry.topic),
        std::string(entry.text),
        0};
    std::optional<std::string> failure;
    bool bRecovered = false;
    bool bWake = false;
    {
        const std::lock_guard lock(_impl->mutex);
        const std::size_t size = record.GetSize();
        if (_impl->queuedBytes + size > _impl->maximumBytes)
        {
            ++_impl->untold;
            ++_impl->lost;
        }
        else
        {
            record.lostBefore = std::exchange(_impl->untold, 0);
            bWake = _impl->queue.empty();
            _impl->queuedBytes += size;
            _impl->queue.push_back(std::move(record));
        }
        failure = std::exchange(_impl->failure, std::nullopt);
        bRecovered = std::exchange(_impl->bRecovered, false);
    }
    if (bWake)
    {
        _impl->wake.notify_one();
    }
    if (failure.has_value())
    {
        _impl->logger.Error(
            "the trace cannot be written, trying again every 10 s; messages are counted as lost meanwhile",
            {{"folder", _impl->path}, {"reason", *failure}});
    }
    if (bRecovered)
    {
        _impl->logger.Info("the trace is written again", {{"folder", _impl->path}});
    }
}

void MessageTrace::SetLimits(const TraceLimits& limits)
{
    const std::lock_guard lock(_impl->mutex);
    _impl->limits = limits;
}

std::uint64_t MessageTrace::GetLost() const
{
    const std::lock_guard lock(_impl->mutex);
    return _impl->lost;
}

} // namespace ACS::Acsd
