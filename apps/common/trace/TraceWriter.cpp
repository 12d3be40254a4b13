#include "common/trace/TraceWriter.hpp"

#include "common/trace/TraceQueue.hpp"

#include <fmt/format.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

namespace ACS::Apps
{

namespace
{

/// Time between two attempts to write after a failure.
constexpr std::chrono::seconds RETRY{10};

} // namespace

struct TraceWriter::Impl
{
    const Core::IClock& clock;
    Core::Logger logger;
    Options options; ///< The mutex protects its limits.

    std::mutex mutex; ///< Protects the members up to the thread's own.
    std::condition_variable wake;
    TraceQueue queue;
    std::uint64_t lost = 0;
    std::optional<std::string> failureOrNull; ///< Error to be logged by the caller's thread.
    bool bRecovered = false;                  ///< Recovery to be logged by the caller's thread.
    bool bClosing = false;
    bool bKept = false;

    // Used by the writer's thread only.
    TraceFiles files;
    std::optional<Core::SteadyTime> failedAt;
    std::uint64_t unwritten = 0; ///< Number of lost lines that no line of the trace states yet.
    std::thread thread;

    Impl(Options writerOptions, const Core::IClock& writerClock, Core::Logger writerLogger)
        : clock(writerClock),
          logger(std::move(writerLogger)),
          options(std::move(writerOptions)),
          queue(options.maxQueuedBytes),
          files(options.path, options.files)
    {
    }

    void Run()
    {
        std::unique_lock lock(mutex);
        while (!bClosing || !queue.IsEmpty() || queue.HasLost())
        {
            WaitForWork(lock);
            const TraceQueue::Entries entries = queue.TakeEntries();
            const std::uint64_t lostAtEnd = bClosing ? queue.TakeLost() : 0;
            const TraceLimits limits = options.limits;
            lock.unlock();
            WriteAll(entries, lostAtEnd, limits);
            lock.lock();
        }
        const TraceLimits limits = options.limits;
        lock.unlock();
        static_cast<void>(TryWriteLoss(clock.GetNow(), limits));
    }

    /// After a failure at most RETRY: what is lost is stated also if no line follows.
    void WaitForWork(std::unique_lock<std::mutex>& lock)
    {
        const auto hasWork = [this] {
            return bClosing || !queue.IsEmpty();
        };
        if (failedAt.has_value())
        {
            wake.wait_for(lock, RETRY, hasWork);
        }
        else
        {
            wake.wait(lock, hasWork);
        }
    }

    void WriteAll(const TraceQueue::Entries& entries, std::uint64_t lostAtEnd, const TraceLimits& limits)
    {
        for (const TraceQueue::Entry& entry : entries)
        {
            unwritten += entry.lostBefore;
            const bool bPausing = failedAt.has_value() && entry.now.steady - *failedAt < RETRY;
            if (bPausing || !TryWriteLoss(entry.now, limits))
            {
                AddLost(1);
                continue;
            }
            Check(files.Append(entry.line, limits), entry.now);
        }
        const Core::Now now = entries.empty() ? clock.GetNow() : entries.back().now;
        unwritten += lostAtEnd;
        if (lostAtEnd > 0 || entries.empty()) // it closes, or RETRY has passed since a failure
        {
            static_cast<void>(TryWriteLoss(now, limits));
        }
        Check(files.Flush(), now);
    }

    /// Writes the number of lost lines before the next line. False if the trace still cannot be written.
    [[nodiscard]] bool TryWriteLoss(Core::Now now, const TraceLimits& limits)
    {
        if (unwritten == 0)
        {
            return true;
        }
        // Written separately: a line lost from here on is either a message or this one.
        std::error_code error = files.Flush();
        Check(error, now);
        if (error)
        {
            return false;
        }
        error = files.Append(options.makeLossLine(unwritten, now), limits);
        if (!error)
        {
            error = files.Flush();
        }
        if (error)
        {
            OnFailed(error, now);
            return false;
        }
        unwritten = 0;
        if (std::exchange(failedAt, std::nullopt).has_value())
        {
            const std::lock_guard lock(mutex);
            bRecovered = true;
        }
        return true;
    }

    void Check(const std::error_code& error, Core::Now now)
    {
        if (error)
        {
            OnFailed(error, now);
            AddLost(files.GetLostLines());
        }
    }

    void OnFailed(const std::error_code& error, Core::Now now)
    {
        if (!std::exchange(failedAt, now.steady).has_value())
        {
            const std::lock_guard lock(mutex);
            failureOrNull = error.message();
        }
    }

    void AddLost(std::uint64_t count)
    {
        unwritten += count;
        const std::lock_guard lock(mutex);
        lost += count;
    }
};

TraceWriter::TraceWriter(Options options, const Core::IClock& clock, Core::Logger logger)
    : _impl(std::make_unique<Impl>(std::move(options), clock, std::move(logger)))
{
}

TraceWriter::~TraceWriter()
{
    Close();
}

std::error_code TraceWriter::Open()
{
    const std::error_code error = _impl->files.Open(_impl->options.limits);
    if (!error)
    {
        _impl->thread = std::thread([&impl = *_impl] { impl.Run(); });
    }
    return error;
}

void TraceWriter::Keep()
{
    std::size_t most = 0;
    {
        const std::lock_guard lock(_impl->mutex);
        _impl->bKept = true;
        most = _impl->options.limits.maxFiles;
    }
    DeleteOldestFiles(_impl->options.path, _impl->options.files.prefix, most);
}

void TraceWriter::Write(std::string line, Core::Now now)
{
    bool bWake = false;
    {
        const std::lock_guard lock(_impl->mutex);
        const bool bWasEmpty = _impl->queue.IsEmpty();
        const bool bQueued = _impl->queue.TryPush(std::move(line), now);
        bWake = bWasEmpty && bQueued;
        _impl->lost += bQueued ? 0 : 1;
    }
    if (bWake)
    {
        _impl->wake.notify_one();
    }
    LogState();
}

void TraceWriter::LogState()
{
    std::optional<std::string> failure;
    bool bRecovered = false;
    {
        const std::lock_guard lock(_impl->mutex);
        failure = std::exchange(_impl->failureOrNull, std::nullopt);
        bRecovered = std::exchange(_impl->bRecovered, false);
    }
    if (failure.has_value())
    {
        _impl->logger.Error(
            fmt::format(
                "the {} cannot be written; retrying every 10 s, lines are lost meanwhile",
                _impl->options.subject),
            {{"path", _impl->options.path}, {"reason", *failure}});
    }
    if (bRecovered)
    {
        _impl->logger.Info(
            fmt::format("the {} is written again", _impl->options.subject),
            {{"path", _impl->options.path}});
    }
}

void TraceWriter::SetLimits(const TraceLimits& limits)
{
    const std::lock_guard lock(_impl->mutex);
    _impl->options.limits = limits;
}

void TraceWriter::Close()
{
    {
        const std::lock_guard lock(_impl->mutex);
        _impl->bClosing = true;
    }
    _impl->wake.notify_one();
    if (_impl->thread.joinable())
    {
        _impl->thread.join();
        if (!_impl->bKept)
        {
            _impl->files.Discard();
        }
        LogState();
    }
}

std::uint64_t TraceWriter::GetLost() const
{
    const std::lock_guard lock(_impl->mutex);
    return _impl->lost;
}

} // namespace ACS::Apps
