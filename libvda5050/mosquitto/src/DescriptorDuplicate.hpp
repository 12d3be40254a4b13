#pragma once

#include <boost/asio/posix/stream_descriptor.hpp>

#include <system_error>

namespace ACS::VDA5050
{

/// Has the stream watch a duplicate of the descriptor. Where that fails nothing is left open but the descriptor itself.
[[nodiscard]] std::error_code AssignDuplicate(boost::asio::posix::stream_descriptor& stream, int descriptor);

} // namespace ACS::VDA5050
