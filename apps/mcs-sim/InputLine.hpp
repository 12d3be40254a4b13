#pragma once

#include <boost/asio/any_io_executor.hpp>

#include <functional>
#include <memory>

namespace ACS::McsSim
{

/// Calls its handler once, when a line has come on standard input, or none can come any more (the end of the input, or
/// something that cannot be waited for, such as /dev/null).
class InputLine
{
    struct Impl;
    std::shared_ptr<Impl> _impl;

public:
    InputLine(const boost::asio::any_io_executor& executor, std::function<void()> handler);
    InputLine(const InputLine&) = delete;
    InputLine& operator=(const InputLine&) = delete;
    /// The handler is not called any more.
    ~InputLine();
};

} // namespace ACS::McsSim
