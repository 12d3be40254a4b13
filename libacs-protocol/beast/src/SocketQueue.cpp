#include "SocketQueue.hpp"

#include <linux/sockios.h>
#include <sys/ioctl.h>

namespace ACS::ProtocolBeast
{

std::size_t CountUntaken(int socket) noexcept
{
    int bytes = 0;
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-vararg): that is how the system asks
    return ::ioctl(socket, SIOCOUTQ, &bytes) == 0 && bytes > 0 ? static_cast<std::size_t>(bytes) : 0;
}

} // namespace ACS::ProtocolBeast
