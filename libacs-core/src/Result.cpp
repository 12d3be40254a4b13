#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <utility>

namespace ACS::Core
{

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

} // namespace ACS::Core
