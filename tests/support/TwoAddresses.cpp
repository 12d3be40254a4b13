#include "TwoAddresses.hpp"

#include <boost/asio/ip/address.hpp>
#include <boost/system/error_code.hpp>

#include <cstddef>
#include <netdb.h>
#include <string_view>

namespace ACS::Testing
{

namespace
{

constexpr const char* SILENT_ADDRESS = "127.0.0.2";
constexpr const char* LIVE_ADDRESS = "127.0.0.1";

} // namespace

TwoAddresses::TwoAddresses(boost::asio::io_context& io, std::uint16_t port)
    : _silent(io)
{
    const Tcp::endpoint endpoint(boost::asio::ip::make_address(SILENT_ADDRESS), port);
    _silent.open(endpoint.protocol());
    _silent.bind(endpoint);
    _silent.listen(0);
    constexpr std::size_t MORE_THAN_THE_QUEUE = 4;
    _waiting.reserve(MORE_THAN_THE_QUEUE);
    while (_waiting.size() < MORE_THAN_THE_QUEUE)
    {
        _waiting.emplace_back(io).async_connect(endpoint, [](const boost::system::error_code& /*error*/) {});
    }
}

} // namespace ACS::Testing

// The linker lets calls of getaddrinfo end here. NOLINTBEGIN(bugprone-reserved-identifier,readability-identifier-naming)
extern "C"
{
    int __real_getaddrinfo(const char* host, const char* service, const addrinfo* hints, addrinfo** found);

    int __wrap_getaddrinfo(const char* host, const char* service, const addrinfo* hints, addrinfo** found)
    {
        using ACS::Testing::TwoAddresses;
        if (host == nullptr || std::string_view(host) != TwoAddresses::HOST)
        {
            return __real_getaddrinfo(host, service, hints, found);
        }
        const int error = __real_getaddrinfo(ACS::Testing::SILENT_ADDRESS, service, hints, found);
        return error != 0 ? error : __real_getaddrinfo(ACS::Testing::LIVE_ADDRESS, service, hints, &(*found)->ai_next);
    }
}
// NOLINTEND(bugprone-reserved-identifier,readability-identifier-naming)
