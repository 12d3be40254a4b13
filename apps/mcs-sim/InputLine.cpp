#include "InputLine.hpp"

#include <boost/asio/buffer.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/read_until.hpp>

#include <cstddef>
#include <string>
#include <unistd.h>
#include <utility>

namespace ACS::McsSim
{

namespace
{

constexpr std::size_t MAX_LINE = 4096;

} // namespace

struct InputLine::Impl
{
    boost::asio::posix::stream_descriptor input;
    std::string line;
    std::function<void()> handler;

    Impl(const boost::asio::any_io_executor& executor, std::function<void()> onLine)
        : input(executor),
          handler(std::move(onLine))
    {
    }
};

InputLine::InputLine(const boost::asio::any_io_executor& executor, std::function<void()> handler)
    : _impl(std::make_shared<Impl>(executor, std::move(handler)))
{
    // A copy, so that closing it leaves standard input alone.
    boost::system::error_code code;
    _impl->input.assign(::dup(STDIN_FILENO), code); // NOLINT(android-cloexec-dup): starts no programs
    boost::asio::async_read_until(
        _impl->input,
        boost::asio::dynamic_buffer(_impl->line, MAX_LINE),
        '\n',
        [weak = std::weak_ptr<Impl>(_impl)](const boost::system::error_code& /*any end will do*/, std::size_t) {
            const std::shared_ptr<Impl> self = weak.lock();
            if (self != nullptr && self->handler)
            {
                std::exchange(self->handler, nullptr)();
            }
        });
}

InputLine::~InputLine()
{
    _impl->handler = nullptr;
}

} // namespace ACS::McsSim
