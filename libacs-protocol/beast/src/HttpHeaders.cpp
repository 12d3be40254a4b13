#include "HttpHeaders.hpp"

#include <acs/core/ECoreError.hpp>

#include <algorithm>
#include <string>
#include <string_view>

namespace ACS::ProtocolBeast
{

namespace
{

/// A token of RFC 9110, section 5.6.2.
bool IsToken(std::string_view text)
{
    constexpr std::string_view ALLOWED = "!#$%&'*+-.^_`|~0123456789"
                                         "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
    return !text.empty() && text.find_first_not_of(ALLOWED) == std::string_view::npos;
}

bool IsFieldValue(std::string_view text)
{
    return std::none_of(text.begin(), text.end(), [](char byte) {
        const auto code = static_cast<unsigned char>(byte);
        return (code < ' ' && byte != '\t') || byte == '\x7F';
    });
}

} // namespace

Core::Result<void> CheckHeaders(const ClientOptions& options)
{
    if (!IsFieldValue(options.host))
    {
        return Core::Fail(
            Core::ECoreError::OutOfRange,
            "host",
            "a host without control characters",
            Core::QuoteForError(options.host));
    }
    for (const auto& [name, value] : options.headers)
    {
        if (!IsToken(name))
        {
            return Core::Fail(
                Core::ECoreError::OutOfRange,
                "headers",
                "the name of an HTTP header",
                Core::QuoteForError(name));
        }
        if (!IsFieldValue(value))
        {
            return Core::Fail(
                Core::ECoreError::OutOfRange,
                "headers." + name,
                "a value without control characters"); // which may be a password: not shown
        }
    }
    return {};
}

} // namespace ACS::ProtocolBeast
