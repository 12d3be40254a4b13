#include <acs/core/ECoreError.hpp>
#include <acs/plan_postgres/PostgresOptions.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <utility>

#include <libpq-fe.h>

namespace ACS::Planning
{

namespace
{

constexpr std::string_view EXPECTED =
    "a URL such as postgresql://user@host:5432/database?sslmode=verify-full&sslrootcert=FILE";

/// One of several hosts, separated by commas: a path is the folder of a local socket.
bool IsOfThisMachine(std::string_view host)
{
    return host.empty() || host.starts_with('/') || host.starts_with('@') || host == "localhost" || host == "::1"
        || host.starts_with("127.");
}

bool HasOtherMachine(std::string_view hosts)
{
    while (true)
    {
        const std::size_t comma = hosts.find(',');
        if (!IsOfThisMachine(hosts.substr(0, comma)))
        {
            return true;
        }
        if (comma == std::string_view::npos)
        {
            return false;
        }
        hosts.remove_prefix(comma + 1);
    }
}

/// The URL without a password and without parameters.
std::string RemoveSecrets(std::string_view url)
{
    const std::size_t begin = url.find("//") + 2;
    const std::string_view rest = url.substr(begin, url.find('?') - begin);
    const std::size_t end = std::min(rest.find('/'), rest.size());
    const std::size_t at = rest.substr(0, end).rfind('@');
    const std::string_view user =
        at == std::string_view::npos ? std::string_view() : rest.substr(0, std::min(rest.find(':'), at));
    const std::string_view place = at == std::string_view::npos ? rest : rest.substr(at);
    return fmt::format("postgresql://{}{}", user, place);
}

/// The values that the URL gives, by their keywords. Errors: the reason of libpq.
tl::expected<std::map<std::string, std::string>, std::string> ReadParameters(const std::string& url)
{
    char* reason = nullptr;
    const std::unique_ptr<PQconninfoOption, void (*)(PQconninfoOption*)> options(
        PQconninfoParse(url.c_str(), &reason),
        &PQconninfoFree);
    const std::unique_ptr<char, void (*)(void*)> ownedReason(reason, &PQfreemem);
    if (options == nullptr)
    {
        std::string text(reason == nullptr ? "no memory" : reason);
        text.erase(std::find(text.begin(), text.end(), '\n'), text.end());
        // It may repeat the URL, with a password.
        return tl::unexpected(text.find("postgres") == std::string::npos ? text : "a URL that cannot be read");
    }
    std::map<std::string, std::string> parameters;
    for (const PQconninfoOption* option = options.get(); option->keyword != nullptr; ++option)
    {
        if (option->val != nullptr)
        {
            parameters.emplace(option->keyword, option->val);
        }
    }
    return parameters;
}

} // namespace

Core::Result<PostgresTarget> ReadPostgresURL(const std::string& url)
{
    if (!url.starts_with("postgresql://") && !url.starts_with("postgres://"))
    {
        return Core::Fail(
            make_error_code(Core::ECoreError::InvalidLocation),
            {},
            std::string(EXPECTED),
            url.find("://") == std::string::npos ? "no URL" : Core::QuoteForError(url.substr(0, url.find("://"))));
    }
    auto parameters = ReadParameters(url);
    if (!parameters.has_value())
    {
        return Core::Fail(
            make_error_code(Core::ECoreError::InvalidLocation),
            {},
            std::string(EXPECTED),
            std::move(parameters.error()));
    }
    PostgresTarget target;
    target.bPassword = parameters->contains("password");
    // A URL without host means the local socket.
    const std::string hosts = parameters->contains("hostaddr") ? (*parameters)["hostaddr"] : (*parameters)["host"];
    target.bOtherMachine = HasOtherMachine(hosts);
    const std::string& mode = (*parameters)["sslmode"];
    target.bVerified = mode == "verify-full" || (mode.empty() && target.bOtherMachine);
    target.name = RemoveSecrets(url);
    const std::string& ports = (*parameters)["port"];
    if (ports.find_first_not_of("0123456789,") != std::string::npos)
    {
        return Core::Fail(
            make_error_code(Core::ECoreError::InvalidLocation),
            {},
            std::string(EXPECTED),
            "the port " + Core::QuoteForError(ports));
    }
    return target;
}

} // namespace ACS::Planning
