#pragma once

#include <acs/core/BoundedQueue.hpp>
#include <acs/core/ControlCharacter.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/ShortText.hpp>

#include <fmt/core.h>

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <mutex>
#include <optional>
#include <poll.h>
#include <string>
#include <string_view>
#include <sys/types.h>
#include <thread>
#include <unistd.h>

/// Keeps log lines in a queue and writes them to standard output on a thread of its own. Lines for which the queue has no
/// room are dropped and counted; the log states how many are missing, and where.
/// Libraries may log on threads of their own, hence the lock, which is held for the queue only, never while a line is written.
class QueuedLog final : public ACS::Core::ILogSink
{
    static constexpr std::size_t CAPACITY = 100;   ///< Lines in the queue.
    static constexpr int END_MILLISECONDS = 5'000; ///< Close waits this long for a reader that does not read.

    std::mutex _mutex;
    std::condition_variable _changed;
    ACS::Core::BoundedQueue<std::string> _lines{CAPACITY};
    std::uint64_t _missing = 0; ///< Dropped, and not yet stated in the log.
    std::uint64_t _dropped = 0;
    bool _bClosing = false;
    std::thread _writer{[this]() {
        WriteLines();
    }}; // The last member: the others exist when it begins.

public:
    QueuedLog() = default;
    QueuedLog(const QueuedLog&) = delete;
    QueuedLog& operator=(const QueuedLog&) = delete;

    ~QueuedLog() override
    {
        Close();
    }

    [[nodiscard]] bool ShouldWrite(ACS::Core::ELogLevel level) const override
    {
        return level >= ACS::Core::ELogLevel::Info;
    }

    void Write(
        ACS::Core::ELogLevel level,
        std::string_view component,
        std::string_view message,
        std::initializer_list<ACS::Core::LogField> fields) override
    {
        std::string line =
            fmt::format("{} {}: ", level >= ACS::Core::ELogLevel::Warning ? "WARNING" : "info", component);
        AppendSafe(line, message);
        for (const ACS::Core::LogField& field : fields)
        {
            line += fmt::format(" {}=", field.key);
            AppendSafe(line, field.value);
        }
        const std::lock_guard lock(_mutex);
        // Once lines are missing, half of the queue must be free: otherwise every second line would state a gap.
        if (_missing == 0 || _lines.GetSize() <= CAPACITY / 2)
        {
            if (_missing > 0 && _lines.TryPush(DescribeGap()))
            {
                _missing = 0;
            }
            if (_lines.TryPush(line + "\n"))
            {
                _changed.notify_one();
                return;
            }
        }
        ++_missing;
        ++_dropped;
    }

    /// Writes what is in the queue. Returns the number of dropped lines.
    std::uint64_t Close()
    {
        {
            const std::lock_guard lock(_mutex);
            _bClosing = true;
        }
        _changed.notify_one();
        if (_writer.joinable())
        {
            _writer.join();
        }
        return _dropped;
    }

private:
    /// A peer chose this text: a line end in it must not look like a line of this program.
    static void AppendSafe(std::string& out, std::string_view text)
    {
        for (const char letter : ACS::Core::ShortenText(text))
        {
            out += ACS::Core::IsControlCharacter(letter) ? '?' : letter;
        }
    }

    [[nodiscard]] std::string DescribeGap() const
    {
        return fmt::format("WARNING log: {} lines dropped: the reader of the log is too slow\n", _missing);
    }

    void WriteLines()
    {
        for (std::unique_lock lock(_mutex);;)
        {
            _changed.wait(lock, [this]() { return _bClosing || !_lines.IsEmpty(); });
            std::optional<std::string> line = _lines.PopFrontOrNull();
            if (!line.has_value() && _missing > 0)
            {
                line = DescribeGap();
                _missing = 0;
            }
            if (!line.has_value())
            {
                return; // Closing, and all is written.
            }
            lock.unlock();
            const bool bWritten = TryWriteLine(*line);
            lock.lock();
            if (!bWritten)
            {
                _dropped += 1 + _lines.GetSize(); // These, and from now on each one for which the queue has no room.
                return;
            }
        }
    }

    /// Waits for the reader, after Close only for a limited time. False if the reader has ended.
    [[nodiscard]] bool TryWriteLine(std::string_view text)
    {
        pollfd output{STDOUT_FILENO, POLLOUT, 0};
        while (!text.empty())
        {
            if (::poll(&output, 1, END_MILLISECONDS) == 0)
            {
                const std::lock_guard lock(_mutex);
                if (_bClosing)
                {
                    return false;
                }
                continue;
            }
            const ssize_t count = ::write(STDOUT_FILENO, text.data(), text.size());
            if (count < 0)
            {
                return false;
            }
            text.remove_prefix(static_cast<std::size_t>(count));
        }
        return true;
    }
};
