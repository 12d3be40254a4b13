#pragma once

#include <boost/asio/any_io_executor.hpp>

#include <functional>
#include <memory>
#include <string>

namespace ACS::McsSim
{

/// Reads standard input line by line. Of a line above MAX_CONSOLE_LINE only the beginning is passed, which is above it too.
/// At the end of the input, or where it is something that cannot be waited for (such as /dev/null), the other handler is
/// called once, and nothing follows.
class InputLines
{
    struct Impl;
    std::shared_ptr<Impl> _impl;

public:
    /// The handlers may end the program's loop, not destroy this.
    InputLines(
        const boost::asio::any_io_executor& executor,
        std::function<void(const std::string& line)> onLine,
        std::function<void()> onEnd);
    InputLines(const InputLines&) = delete;
    InputLines& operator=(const InputLines&) = delete;
    /// The handlers are not called any more.
    ~InputLines();
};

} // namespace ACS::McsSim
