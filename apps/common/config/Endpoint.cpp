#include "common/config/Endpoint.hpp"

#include <acs/core/ParseNumber.hpp>

#include <boost/asio/ip/address.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace ACS::Apps
{

namespace
{

constexpr std::string_view ALLOWED = "HOST:PORT with a port from 0 to 65535, such as 127.0.0.1:9001 or [::1]:9001";

bool IsHostCharacter(char character)
{
    const bool bAlphanumeric = (character >= 'a' && character <= 'z') || (character >= 'A' && character <= 'Z')
        || (character >= '0' && character <= '9');
    return bAlphanumeric || character == '.' || character == '-' || character == '_';
}

bool IsAddressCharacter(char character)
{
    return IsHostCharacter(character) || character == ':' || character == '%';
}

std::optional<std::string> ReadHostOrNull(std::string_view text)
{
    const bool bBracketed = text.size() > 2 && text.front() == '[' && text.back() == ']';
    const std::string_view host = bBracketed ? text.substr(1, text.size() - 2) : text;
    const bool bValid =
        !host.empty() && std::all_of(host.begin(), host.end(), bBracketed ? IsAddressCharacter : IsHostCharacter);
    return bValid ? std::optional<std::string>(host) : std::nullopt;
}

} // namespace

Core::Result<Endpoint> ParseEndpoint(std::string_view text)
{
    const std::size_t colon = text.rfind(':');
    if (colon != std::string_view::npos)
    {
        std::optional<std::string> host = ReadHostOrNull(text.substr(0, colon));
        const std::optional<std::uint16_t> port = Core::ParseNumberOrNull<std::uint16_t>(text.substr(colon + 1));
        if (host.has_value() && port.has_value())
        {
            return Endpoint{std::move(*host), *port};
        }
    }
    return Core::Fail(Core::ECoreError::OutOfRange, {}, std::string(ALLOWED), fmt::format("'{}'", text));
}

bool IsLoopback(const std::string& host)
{
    boost::system::error_code error;
    const boost::asio::ip::address address = boost::asio::ip::make_address(host, error);
    if (error.failed())
    {
        return host == "localhost";
    }
    if (address.is_v6() && address.to_v6().is_v4_mapped())
    {
        return boost::asio::ip::make_address_v4(boost::asio::ip::v4_mapped, address.to_v6()).is_loopback();
    }
    return address.is_loopback();
}

std::string MakeText(const Endpoint& endpoint)
{
    const bool bNeedsBrackets = endpoint.host.find(':') != std::string::npos;
    return bNeedsBrackets ? fmt::format("[{}]:{}", endpoint.host, endpoint.port)
                          : fmt::format("{}:{}", endpoint.host, endpoint.port);
}

} // namespace ACS::Apps
