#pragma once

#include <string>
#include <string_view>

namespace ACS::Core
{

/// The URL for logs and errors: without what may be a secret in it, the user information and the query. Any text is accepted.
[[nodiscard]] inline std::string MakeShownURL(std::string_view url)
{
    const std::string_view separator = "://";
    const std::size_t query = url.find('?');
    const std::string_view place = url.substr(0, query);
    const std::size_t scheme = place.find(separator);
    const std::size_t begin = scheme == std::string_view::npos ? 0 : scheme + separator.size();
    const std::size_t user = place.rfind('@'); // also behind a '/': a password may have one
    std::string shown(place);
    if (user != std::string_view::npos && user >= begin)
    {
        shown.replace(begin, user - begin, "***");
    }
    return query == std::string_view::npos ? shown : shown + "?***";
}

} // namespace ACS::Core
