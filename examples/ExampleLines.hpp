#pragma once

#include <boost/asio/buffer.hpp>
#include <boost/asio/error.hpp>
#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>

#include <array>
#include <cstddef>
#include <fcntl.h>
#include <functional>
#include <iostream>
#include <string>
#include <string_view>
#include <unistd.h>
#include <utility>

/// Reads the standard input line by line beside the program's other work: a keyboard, a pipe or a file. A last line
/// without its line end is a line, too. Must outlive the io_context's work.
class ExampleLines
{
    static constexpr std::size_t MAX_LINE = 1'048'576; ///< Bytes; the rest of a longer one is forgotten.

    boost::asio::posix::stream_descriptor _input;
    std::function<void(const std::string&)> _onLine;
    std::function<void()> _onEnd;
    std::array<char, 4096> _chunk{};
    std::string _line;

public:
    ExampleLines(
        boost::asio::io_context& io,
        std::function<void(const std::string&)> onLine,
        std::function<void()> onEnd)
        : _input(io, CopyInput()),
          _onLine(std::move(onLine)),
          _onEnd(std::move(onEnd))
    {
        ReadAsync();
    }

private:
    /// A terminal is opened again: Asio makes the copy non-blocking, and that would remain after the program and hold for the
    /// others on the terminal.
    [[nodiscard]] static int CopyInput()
    {
        int copy = -1;
        if (::isatty(STDIN_FILENO) == 1)
        {
            // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): the system's interface
            copy = ::open("/proc/self/fd/0", O_RDONLY | O_CLOEXEC | O_NOCTTY);
        }
        return copy >= 0 ? copy : ::dup(STDIN_FILENO); // A terminal of another user cannot be opened.
    }

    void ReadAsync()
    {
        _input.async_read_some(
            boost::asio::buffer(_chunk),
            [this](const boost::system::error_code& error, std::size_t count) {
                if (error)
                {
                    OnEnd(error);
                    return;
                }
                OnRead({_chunk.data(), count});
                ReadAsync();
            });
    }

    void OnRead(std::string_view text)
    {
        for (const char letter : text)
        {
            if (letter == '\n')
            {
                _onLine(std::exchange(_line, {}));
            }
            else if (_line.size() < MAX_LINE)
            {
                _line += letter;
            }
        }
    }

    void OnEnd(const boost::system::error_code& error)
    {
        if (error == boost::asio::error::operation_not_supported) // A file is not to be waited for: it is all there.
        {
            for (std::string line; std::getline(std::cin, line);)
            {
                _onLine(line);
            }
        }
        if (!_line.empty())
        {
            _onLine(std::exchange(_line, {}));
        }
        _onEnd();
    }
};
