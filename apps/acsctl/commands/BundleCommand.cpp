#include "commands/BundleCommand.hpp"

#include "bundle/SupportBundle.hpp"
#include "common/process/SystemClock.hpp"
#include "http/ApiClient.hpp"
#include "http/ClientTls.hpp"
#include "view/DisplayText.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstddef>
#include <fcntl.h>
#include <memory>
#include <string_view>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace ACS::Acsctl
{

namespace
{

/// Writes a new file, readable by its user only; it is removed again if that fails.
Outcome<void> WriteNewFile(const std::string& path, std::string_view bytes)
{
    const int file = ::open( // NOLINT(cppcoreguidelines-pro-type-vararg): the system's signature
        path.c_str(),
        O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC,
        S_IRUSR | S_IWUSR);
    const auto fail = [&path](int reason) {
        return FailWith(EXIT_LOCAL_FAILURE, fmt::format("{}: {}", path, std::generic_category().message(reason)));
    };
    if (file < 0)
    {
        return fail(errno);
    }
    int reason = 0;
    while (!bytes.empty() && reason == 0)
    {
        const ssize_t count = ::write(file, bytes.data(), bytes.size());
        if (count >= 0)
        {
            bytes.remove_prefix(static_cast<std::size_t>(count));
        }
        else if (errno != EINTR)
        {
            reason = errno;
        }
    }
    if (::close(file) != 0 && reason == 0)
    {
        reason = errno;
    }
    if (reason != 0)
    {
        static_cast<void>(::unlink(path.c_str()));
        return fail(reason);
    }
    return {};
}

/// The client for http.listen, which needs no identification and gets none; null without --http-url.
Outcome<std::unique_ptr<ApiClient>> MakeHttpClient(Session& session, const AcsctlOptions& options)
{
    if (!options.arguments.httpURL.has_value())
    {
        return std::unique_ptr<ApiClient>();
    }
    Connection connection;
    auto url = ParseHttpURL(*options.arguments.httpURL);
    if (!url.has_value())
    {
        return FailWith(EXIT_BAD_INPUT, "--http-url: " + url.error());
    }
    connection.url = std::move(*url);
    auto tls = MakeClientTLS(connection);
    if (!tls.has_value())
    {
        return FailWith(EXIT_BAD_INPUT, tls.error());
    }
    return std::make_unique<ApiClient>(session.GetLoop(), std::move(connection), std::move(*tls), options.timeout);
}

} // namespace

Outcome<Shown> RunBundle(Session& session, const AcsctlOptions& options)
{
    const Outcome<std::unique_ptr<ApiClient>> http = MakeHttpClient(session, options);
    if (!http.has_value())
    {
        return tl::make_unexpected(http.error());
    }
    const Outcome<SupportBundle> bundle =
        CollectBundle(session.GetAPI(), http->get(), session.GetURL(), Apps::SystemClock().GetNow().wall);
    if (!bundle.has_value())
    {
        return tl::make_unexpected(bundle.error());
    }
    const std::string& path = options.arguments.id;
    if (const Outcome<void> written = WriteNewFile(path, bundle->archive); !written.has_value())
    {
        return tl::make_unexpected(written.error());
    }
    const int exitCode = bundle->bForeign ? EXIT_BAD_ANSWER : EXIT_DONE;
    if (options.bJSON)
    {
        return Shown{bundle->manifest, exitCode};
    }
    std::string out = fmt::format("{}: {} bytes\n", path, bundle->archive.size());
    for (const std::string& missing : bundle->missing)
    {
        out += fmt::format("not in it: {}\n", MakeDisplayable(missing));
    }
    return Shown{std::move(out), exitCode};
}

} // namespace ACS::Acsctl
