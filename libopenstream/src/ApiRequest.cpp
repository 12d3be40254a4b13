#include <acs/json/JsonDocument.hpp>
#include <acs/openstream/ApiRequest.hpp>

#include <algorithm>
#include <set>
#include <utility>

namespace ACS::OpenStream
{

namespace
{

constexpr int FIRST_SUCCESS = 200;
constexpr int BEYOND_SUCCESS = 300;
constexpr std::string_view HEX = "0123456789ABCDEF";

bool IsUnreserved(char letter)
{
    const bool bLetter = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z');
    const bool bDigit = letter >= '0' && letter <= '9';
    return bLetter || bDigit || std::string_view("-._~,:").find(letter) != std::string_view::npos;
}

void AppendEncoded(std::string_view text, std::string& out)
{
    for (const char letter : text)
    {
        if (IsUnreserved(letter))
        {
            out += letter;
            continue;
        }
        const auto byte = static_cast<unsigned char>(letter);
        out += '%';
        out += HEX[byte >> 4U];
        out += HEX[byte & 0xFU];
    }
}

/// The value of a hexadecimal digit; HEX.size() for another character.
std::size_t ReadHexDigit(char letter)
{
    const bool bSmall = letter >= 'a' && letter <= 'f';
    const std::size_t found = HEX.find(bSmall ? static_cast<char>(letter - 'a' + 'A') : letter);
    return std::min(found, HEX.size());
}

/// As an HTTP server reads a query: '+' is a blank. An invalid escape stays as it is.
std::string DecodeQuery(std::string_view text)
{
    constexpr std::size_t ESCAPE = 3; // Characters of "%20".
    std::string decoded;
    decoded.reserve(text.size());
    while (!text.empty())
    {
        const bool bEscape = text.front() == '%' && text.size() >= ESCAPE;
        const std::size_t high = bEscape ? ReadHexDigit(text[1]) : HEX.size();
        const std::size_t low = bEscape ? ReadHexDigit(text[2]) : HEX.size();
        const bool bValid = high < HEX.size() && low < HEX.size();
        const char plain = text.front() == '+' ? ' ' : text.front();
        decoded += bValid ? static_cast<char>(high * HEX.size() + low) : plain;
        text.remove_prefix(bValid ? ESCAPE : 1);
    }
    return decoded;
}

std::string_view GetName(const Json::Value::Member& member)
{
    return {member.name.GetString(), member.name.GetStringLength()};
}

} // namespace

const std::string* ApiRequest::GetParameterOrNull(std::string_view name) const noexcept
{
    const auto found = std::ranges::find(query, name, &QueryParameter::name);
    return found == query.end() ? nullptr : &found->value;
}

bool ApiResponse::IsSuccess() const noexcept
{
    return status >= FIRST_SUCCESS && status < BEYOND_SUCCESS;
}

std::string ApiResponse::TakeRoom()
{
    std::string room;
    if (body.has_value())
    {
        room = body->TakeText();
        room.clear();
    }
    status = FIRST_SUCCESS;
    body.reset();
    delay = {};
    bNoSample = false;
    return room;
}

void SplitURL(std::string_view url, ApiRequest& request)
{
    request.query.clear();
    const std::size_t mark = url.find('?');
    request.path.assign(url.substr(0, mark));
    std::string_view rest = mark == std::string_view::npos ? std::string_view() : url.substr(mark + 1);
    while (!rest.empty())
    {
        const std::size_t end = rest.find('&');
        const std::string_view part = rest.substr(0, end);
        rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
        if (part.empty())
        {
            continue;
        }
        const std::size_t equals = part.find('=');
        const std::string_view value = equals == std::string_view::npos ? std::string_view() : part.substr(equals + 1);
        request.query.push_back(QueryParameter{DecodeQuery(part.substr(0, equals)), DecodeQuery(value)});
    }
}

void AddArguments(const Core::JsonText& args, ApiRequest& request)
{
    Json::JsonDocument document;
    const auto root = document.Parse(args.GetText(), Json::ParseLimits{});
    if (!root.has_value() || !(*root)->IsObject())
    {
        return;
    }
    // Once for all of them: a line holds tens of thousands, and whatever they cost, every other session waits for it.
    std::set<std::string_view> names;
    for (const auto& member : (*root)->GetObject())
    {
        names.insert(GetName(member));
    }
    std::erase_if(request.query, [&names](const QueryParameter& parameter) { return names.contains(parameter.name); });
    for (const auto& member : (*root)->GetObject())
    {
        std::string value = member.value.IsString()
            ? std::string(member.value.GetString(), member.value.GetStringLength())
            : Json::WriteText(member.value);
        request.query.push_back(QueryParameter{std::string(GetName(member)), std::move(value)});
    }
}

std::string BuildURL(const ApiRequest& request)
{
    std::string url = request.path;
    char separator = '?';
    for (const QueryParameter& parameter : request.query)
    {
        url += separator;
        separator = '&';
        AppendEncoded(parameter.name, url);
        url += '=';
        AppendEncoded(parameter.value, url);
    }
    return url;
}

} // namespace ACS::OpenStream
