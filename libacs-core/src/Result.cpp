#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <utility>

namespace ACS::Core
{

namespace
{

constexpr std::size_t MAX_QUOTED = 64;

} // namespace

std::string Describe(const Error& error)
{
    std::string text = error.path.empty() ? std::string() : error.path + ": ";
    if (error.expected.empty())
    {
        text += error.code.message();
    }
    else
    {
        text += fmt::format("expected {}", error.expected);
    }
    if (!error.found.empty())
    {
        text += fmt::format(", found {}", error.found);
    }
    return text;
}

tl::unexpected<Error> Fail(std::error_code code, std::string path, std::string expected, std::string found)
{
    return tl::unexpected<Error>(Error{code, std::move(path), std::move(expected), std::move(found)});
}

std::string QuoteForError(std::string_view text)
{
    std::string quoted = "\"";
    for (const char character : text.substr(0, MAX_QUOTED))
    {
        quoted += character >= ' ' && character <= '~' ? character : '?';
    }
    quoted += text.size() > MAX_QUOTED ? "\"..." : "\"";
    return quoted;
}

} // namespace ACS::Core
