#include "common/log/LineWriter.hpp"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <mutex>
#include <poll.h>
#include <thread>
#include <unistd.h>
#include <utility>

namespace ACS::Apps
{

namespace
{

/// A pipe that poll() reports as writable takes as many bytes without blocking: PIPE_BUF of Linux.
constexpr std::size_t CHUNK_BYTES = 4096;
constexpr std::chrono::seconds LAST_WAIT{1};

/// Signals are for the thread of the event loop; without SIGPIPE a closed pipe is an error of write().
void BlockSignals()
{
    sigset_t all;
    sigfillset(&all);
    pthread_sigmask(SIG_BLOCK, &all, nullptr);
}

/// Whether everything was written. Blocks until the descriptor takes it.
bool TryWriteAll(int descriptor, std::string_view text)
{
    while (!text.empty())
    {
        pollfd writable{descriptor, POLLOUT, 0};
        if (poll(&writable, 1, -1) < 0 && errno != EINTR)
        {
            return false;
        }
        const ssize_t written = write(descriptor, text.data(), std::min(text.size(), CHUNK_BYTES));
        if (written < 0 && errno != EINTR && errno != EAGAIN)
        {
            return false;
        }
        text.remove_prefix(written < 0 ? 0 : static_cast<std::size_t>(written));
    }
    return true;
}

} // namespace

/// Shared with the thread, which outlives the writer when its descriptor blocks.
struct LineWriter::Shared
{
    const int descriptor;
    const DescribeDropped describe;
    const std::size_t maximumBytes;
    std::mutex mutex;
    std::condition_variable changed;
    std::string waiting;
    std::uint64_t waitingLines = 0;
    std::uint64_t dropped = 0;
    std::uint64_t reported = 0; ///< Of the dropped lines.
    bool bWriting = false;
    bool bStopping = false;

    Shared(int descriptorToWrite, DescribeDropped describeDropped, std::size_t bytes)
        : descriptor(descriptorToWrite),
          describe(std::move(describeDropped)),
          maximumBytes(bytes)
    {
    }

    void Run()
    {
        BlockSignals();
        std::unique_lock lock(mutex);
        while (true)
        {
            changed.wait(lock, [this] { return bStopping || !waiting.empty(); });
            if (waiting.empty())
            {
                return;
            }
            WriteWaiting(lock);
            changed.notify_all();
        }
    }

    /// Without the lock while it writes.
    void WriteWaiting(std::unique_lock<std::mutex>& lock)
    {
        std::string text = std::exchange(waiting, {});
        const std::uint64_t lines = std::exchange(waitingLines, 0);
        const std::uint64_t missing = dropped - reported;
        reported = dropped;
        bWriting = true;
        lock.unlock();
        if (missing > 0)
        {
            text += describe(missing);
        }
        const bool bWritten = TryWriteAll(descriptor, text);
        lock.lock();
        bWriting = false;
        if (!bWritten)
        {
            dropped += lines;
        }
    }
};

LineWriter::LineWriter(int descriptor, DescribeDropped describe, std::size_t maximumBytes)
    : _shared(std::make_shared<Shared>(descriptor, std::move(describe), maximumBytes))
{
    std::thread([shared = _shared] { shared->Run(); }).detach();
}

LineWriter::~LineWriter()
{
    Flush();
    const std::lock_guard lock(_shared->mutex);
    _shared->bStopping = true;
    _shared->changed.notify_all();
}

void LineWriter::Flush()
{
    std::unique_lock lock(_shared->mutex);
    _shared->changed.wait_for(lock, LAST_WAIT, [this] { return _shared->waiting.empty() && !_shared->bWriting; });
}

void LineWriter::Write(std::string_view line)
{
    const std::lock_guard lock(_shared->mutex);
    if (_shared->waiting.size() + line.size() > _shared->maximumBytes)
    {
        ++_shared->dropped;
        return;
    }
    _shared->waiting += line;
    ++_shared->waitingLines;
    _shared->changed.notify_all();
}

std::uint64_t LineWriter::GetDropped() const
{
    const std::lock_guard lock(_shared->mutex);
    return _shared->dropped;
}

} // namespace ACS::Apps
