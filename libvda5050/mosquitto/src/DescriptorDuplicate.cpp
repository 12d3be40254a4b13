#include "DescriptorDuplicate.hpp"

#include <cerrno>
#include <unistd.h>

namespace ACS::VDA5050
{

std::error_code AssignDuplicate(boost::asio::posix::stream_descriptor& stream, int descriptor)
{
    const int duplicate = dup(descriptor);
    if (duplicate < 0)
    {
        return {errno, std::system_category()};
    }
    boost::system::error_code refused;
    stream.assign(duplicate, refused); // NOLINT(bugprone-unused-return-value): in refused
    if (refused)
    {
        close(duplicate); // a stream takes over what it accepts only
    }
    return refused;
}

} // namespace ACS::VDA5050
