#include <acs/core/ECoreError.hpp>
#include <acs/plan_postgres/PostgresOptions.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <libpq-fe.h>

namespace ACS::Planning
{

namespace
{

constexpr std::string_view EXPECTED =
    "a URL such as postgresql://user@host:5432/database?sslmode=verify-full&sslrootcert=FILE";

/// A path is the folder of a local socket.
bool IsOfThisMachine(std::string_view host)
{
    return host.starts_with('/') || host.starts_with('@') || host == "localhost" || host == "::1"
        || host.starts_with("127.");
}

/// Without a host in the URL, libpq takes it from elsewhere.
bool HasHostElsewhere(const std::map<std::string, std::string>& parameters)
{
    return parameters.contains("service")
        || std::ranges::any_of(std::array{"PGHOST", "PGHOSTADDR", "PGSERVICE"}, [](const char* name) {
               return std::getenv(name) != nullptr;
           });
}

std::vector<std::string> SplitList(std::string_view list)
{
    std::vector<std::string> parts;
    for (std::size_t comma = 0; comma != std::string_view::npos;)
    {
        comma = list.find(',');
        parts.emplace_back(list.substr(0, comma));
        list.remove_prefix(comma == std::string_view::npos ? list.size() : comma + 1);
    }
    return parts;
}

/// One port is that of all hosts. A host may have a name, an address or both.
std::vector<PostgresHost> MakeHosts(const std::string& hosts, const std::string& addresses, const std::string& ports)
{
    const std::vector<std::string> numbers = SplitList(ports);
    const std::vector<std::string> known = addresses.empty() ? std::vector<std::string>() : SplitList(addresses);
    std::vector<PostgresHost> made;
    for (std::string& host : SplitList(hosts.empty() ? addresses : hosts))
    {
        const std::size_t place = made.size();
        const std::size_t index = numbers.size() == 1 ? 0 : place;
        made.push_back(
            {std::move(host),
             index < numbers.size() ? numbers[index] : std::string(),
             place < known.size() ? known[place] : std::string()});
    }
    return made;
}

/// From what libpq has read, so that no part of a password can be in it.
std::string MakeName(const std::string& user, const std::vector<PostgresHost>& hosts, const std::string& database)
{
    std::string name = fmt::format("postgresql://{}{}", user, user.empty() ? "" : "@");
    std::string_view separator;
    for (const PostgresHost& host : hosts)
    {
        const bool bV6 = host.host.find(':') != std::string::npos;
        name += fmt::format(
            "{}{}{}{}{}{}",
            separator,
            bV6 ? "[" : "",
            host.host,
            bV6 ? "]" : "",
            host.port.empty() ? "" : ":",
            host.port);
        separator = ",";
    }
    return fmt::format("{}/{}", name, database);
}

/// The values that the URL gives, by their keywords; nullopt: libpq cannot read it. Its reason may have a part of a password.
std::optional<std::map<std::string, std::string>> ReadParametersOrNull(const std::string& url)
{
    const std::unique_ptr<PQconninfoOption, void (*)(PQconninfoOption*)> options(
        PQconninfoParse(url.c_str(), nullptr),
        &PQconninfoFree);
    if (options == nullptr)
    {
        return std::nullopt;
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

tl::unexpected<Core::Error> Refuse(std::string found)
{
    return Core::Fail(
        make_error_code(Core::ECoreError::InvalidLocation),
        {},
        "a URL such as postgresql://user@host:5432/database?sslmode=verify-full&sslrootcert=FILE, with %2F for / and %40 for @ in a "
        "password",
        std::move(found));
}

} // namespace

Core::Result<PostgresTarget> ReadPostgresURL(const std::string& url)
{
    if (!url.starts_with("postgresql://") && !url.starts_with("postgres://"))
    {
        return Refuse("another kind of text");
    }
    std::optional<std::map<std::string, std::string>> parametersOrNull = ReadParametersOrNull(url);
    if (!parametersOrNull.has_value())
    {
        return Refuse("a URL that cannot be read, or with an unknown parameter");
    }
    std::map<std::string, std::string>& parameters = *parametersOrNull;
    const std::string& ports = parameters["port"];
    const std::string& database = parameters["dbname"];
    if (ports.find_first_not_of("0123456789,") != std::string::npos || database.find('@') != std::string::npos)
    {
        return Refuse("a port that is no number, or a password with these characters");
    }
    const std::string& mode = parameters["sslmode"];
    PostgresTarget target;
    target.hosts = MakeHosts(parameters["host"], parameters["hostaddr"], ports);
    // libpq takes what follows the first @ of a password for the host. A name of a local socket begins with one.
    if (std::ranges::any_of(target.hosts, [](const PostgresHost& host) {
            return host.host.find('@', 1) != std::string::npos;
        }))
    {
        return Refuse("a host name with @, or a password with @ that is not written as %40");
    }
    target.name = MakeName(parameters["user"], target.hosts, database);
    target.bPassword = parameters.contains("password");
    target.bOtherMachine = std::ranges::any_of(target.hosts, [&parameters](const PostgresHost& host) {
        const std::string& place = host.address.empty() ? host.host : host.address;
        return place.empty() ? HasHostElsewhere(parameters) : !IsOfThisMachine(place);
    });
    target.bVerified = mode == "verify-full" || (mode.empty() && target.bOtherMachine);
    return target;
}

} // namespace ACS::Planning
