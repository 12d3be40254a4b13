#include "console/InputLines.hpp"

#include "console/ConsoleCommand.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/read_until.hpp>

#include <cstddef>
#include <fcntl.h>
#include <unistd.h>
#include <utility>

namespace ACS::McsSim
{

namespace
{

constexpr std::size_t MAX_BUFFER = MAX_CONSOLE_LINE + 1; // for the newline

/// A copy of standard input, so that closing it leaves standard input alone. A terminal is opened again: Asio makes the copy
/// non-blocking, which it would share with standard output and with other programs on the terminal.
int CopyInput()
{
    int copy = -1;
    if (::isatty(STDIN_FILENO) == 1)
    {
        // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): the system's interface
        copy = ::open("/proc/self/fd/0", O_RDONLY | O_CLOEXEC | O_NOCTTY);
    }
    // A terminal of another user cannot be opened.
    return copy >= 0 ? copy : ::dup(STDIN_FILENO); // NOLINT(android-cloexec-dup): starts no programs
}

} // namespace

struct InputLines::Impl : std::enable_shared_from_this<InputLines::Impl>
{
    boost::asio::posix::stream_descriptor input;
    std::string buffer;
    bool bRestOfLine = false; ///< Of a line that was too long, and was passed on.
    std::function<void(const std::string& line)> onLine;
    std::function<void()> onEnd;
    std::function<void()> onMore; ///< Reads on: a handler of its own, for Asio's templates are not to call each other.

    Impl(
        const boost::asio::any_io_executor& executor,
        std::function<void(const std::string& line)> lineHandler,
        std::function<void()> endHandler)
        : input(executor),
          onLine(std::move(lineHandler)),
          onEnd(std::move(endHandler))
    {
    }

    void ReadAsync()
    {
        boost::asio::async_read_until(
            input,
            boost::asio::dynamic_buffer(buffer, MAX_BUFFER),
            '\n',
            [weak = weak_from_this()](const boost::system::error_code& error, std::size_t count) {
                const std::shared_ptr<Impl> self = weak.lock();
                if (self != nullptr && self->onLine)
                {
                    self->OnRead(error, count);
                }
            });
    }

    void OnRead(const boost::system::error_code& error, std::size_t count)
    {
        // The buffer is full, and has no newline.
        const bool bCut = error == boost::asio::error::not_found;
        if (error && !bCut)
        {
            onLine = nullptr;
            std::exchange(onEnd, nullptr)();
            return;
        }
        const std::size_t taken = bCut ? buffer.size() : count;
        const std::string line = buffer.substr(0, bCut ? taken : taken - 1);
        buffer.erase(0, taken);
        if (!std::exchange(bRestOfLine, bCut))
        {
            onLine(line);
        }
        if (onLine)
        {
            onMore();
        }
    }
};

InputLines::InputLines(
    const boost::asio::any_io_executor& executor,
    std::function<void(const std::string& line)> onLine,
    std::function<void()> onEnd)
    : _impl(std::make_shared<Impl>(executor, std::move(onLine), std::move(onEnd)))
{
    boost::system::error_code code;
    _impl->input.assign(CopyInput(), code);
    _impl->onMore = [impl = _impl.get()] {
        impl->ReadAsync();
    };
    _impl->ReadAsync();
}

InputLines::~InputLines()
{
    _impl->onLine = nullptr;
    _impl->onEnd = nullptr;
}

} // namespace ACS::McsSim
