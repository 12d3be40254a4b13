#include "common/http/HttpMessage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

namespace ACS::Apps
{

namespace
{

constexpr std::size_t ESCAPE_DIGITS = 2;
constexpr int HEXADECIMAL = 16;

/// Decodes %XX and, in a query, '+' as a blank.
std::optional<std::string> DecodeOrNull(std::string_view text, bool bQuery)
{
    std::string decoded;
    decoded.reserve(text.size());
    for (std::size_t position = 0; position < text.size(); ++position)
    {
        const char character = text[position];
        if (character == '%')
        {
            const std::string_view digits = text.substr(position + 1, ESCAPE_DIGITS);
            unsigned byte = 0;
            const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), byte, HEXADECIMAL);
            if (error != std::errc() || end != digits.data() + ESCAPE_DIGITS)
            {
                return std::nullopt;
            }
            decoded += static_cast<char>(static_cast<unsigned char>(byte));
            position += ESCAPE_DIGITS;
        }
        else
        {
            decoded += bQuery && character == '+' ? ' ' : character;
        }
    }
    return decoded;
}

/// The decoded segments of a path that begins with a slash and can be decoded.
std::vector<std::string> SplitPath(std::string_view path)
{
    std::vector<std::string> segments;
    while (!path.empty())
    {
        path.remove_prefix(1);
        const std::size_t end = std::min(path.find('/'), path.size());
        segments.push_back(*DecodeOrNull(path.substr(0, end), false));
        path.remove_prefix(end);
    }
    return segments;
}

bool TryReadQuery(std::string_view text, std::vector<std::pair<std::string, std::string>>& query)
{
    while (!text.empty())
    {
        const std::size_t end = std::min(text.find('&'), text.size());
        const std::string_view item = text.substr(0, end);
        text.remove_prefix(std::min(end + 1, text.size()));
        if (item.empty())
        {
            continue;
        }
        const std::size_t equals = std::min(item.find('='), item.size());
        std::optional<std::string> name = DecodeOrNull(item.substr(0, equals), true);
        std::optional<std::string> value = DecodeOrNull(item.substr(std::min(equals + 1, item.size())), true);
        if (!name.has_value() || !value.has_value())
        {
            return false;
        }
        query.emplace_back(std::move(*name), std::move(*value));
    }
    return true;
}

} // namespace

std::optional<std::string> HttpRequest::GetQueryOrNull(std::string_view name) const
{
    const auto found =
        std::find_if(query.begin(), query.end(), [name](const auto& parameter) { return parameter.first == name; });
    return found == query.end() ? std::nullopt : std::optional<std::string>(found->second);
}

std::optional<std::string> HttpRequest::GetHeaderOrNull(std::string_view name) const
{
    const auto lower = [](char letter) {
        return letter >= 'A' && letter <= 'Z' ? static_cast<char>(letter - 'A' + 'a') : letter;
    };
    const auto found = std::ranges::find_if(headers, [&](const auto& header) {
        return std::ranges::equal(header.first, name, {}, lower, lower);
    });
    return found == headers.end() ? std::nullopt : std::optional<std::string>(found->second);
}

Core::Result<HttpRequest> ParseHttpTarget(std::string_view target)
{
    const std::size_t question = std::min(target.find('?'), target.size());
    std::optional<std::string> path = DecodeOrNull(target.substr(0, question), false);
    HttpRequest request;
    const bool bQueryValid = TryReadQuery(target.substr(std::min(question + 1, target.size())), request.query);
    if (!path.has_value() || !target.starts_with('/') || !bQueryValid)
    {
        return Core::Fail(Core::ECoreError::OutOfRange, {}, "a path that begins with / and is percent-encoded", {});
    }
    request.path = std::move(*path);
    request.segments = SplitPath(target.substr(0, question));
    request.target = target;
    return request;
}

} // namespace ACS::Apps
