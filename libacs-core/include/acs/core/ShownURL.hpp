#pragma once

#include <algorithm>
#include <string>
#include <string_view>

namespace ACS::Core
{

/// The URL for logs and errors: without what may be a secret in it, the user information, the query and the fragment. If an '@'
/// follows a '?' or '#', a password may have contained that character: then nothing after the scheme is shown. Any text is
/// accepted.
[[nodiscard]] inline std::string MakeShownURL(std::string_view url)
{
    constexpr std::string_view SEPARATOR = "://";
    const std::size_t end = std::min(url.find_first_of("?#"), url.size());
    const std::string_view place = url.substr(0, end);
    const std::size_t scheme = place.find(SEPARATOR);
    const std::size_t begin = scheme == std::string_view::npos ? 0 : scheme + SEPARATOR.size();
    const std::size_t user = url.rfind('@'); // also behind a '/', '?' or '#': a password may have one
    std::string shown(place);
    if (user != std::string_view::npos && user >= end)
    {
        return shown.replace(begin, std::string::npos, "***");
    }
    if (user != std::string_view::npos && user >= begin)
    {
        shown.replace(begin, user - begin, "***");
    }
    return end == url.size() ? shown : shown + url[end] + "***";
}

} // namespace ACS::Core
