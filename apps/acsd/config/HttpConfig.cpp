#include "config/HttpConfig.hpp"

#include "common/config/TextFile.hpp"
#include "config/McsConfig.hpp"
#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <utility>

namespace ACS::Acsd
{

namespace
{

using Apps::ConfigSection;

constexpr std::size_t LARGEST_TOKENS_FILE = 1024U * 1024U;

void ReadListen(const ConfigSection& section, HttpListenConfig& config)
{
    config.listen = section.GetEndpoint("listen", config.listen);
    config.hosts = section.GetStringList("hosts");
    const auto wrong = std::ranges::find_if(config.hosts, [](const std::string& name) {
        return !Apps::ParseEndpoint(name + ":0").has_value();
    });
    if (wrong != config.hosts.end())
    {
        section.AddError(
            "hosts",
            fmt::format(
                R"(expected names without port, such as "acs.example", found {})",
                Core::QuoteForError(*wrong)));
    }
}

void ReadTokens(const ConfigSection& section, const std::string& fileName, OperatorConfig& config)
{
    const std::optional<std::string> path = section.GetStringOrNull("tokens_file");
    if (!path.has_value())
    {
        return;
    }
    config.tokensFile = ResolvePath(fileName, *path);
    const tl::expected<std::string, std::string> text = Apps::ReadTextFileUpTo(config.tokensFile, LARGEST_TOKENS_FILE);
    if (!text.has_value())
    {
        section.AddError(
            "tokens_file",
            fmt::format(
                "{} cannot be read ({}); acsd token ROLE NAME prints its lines",
                config.tokensFile,
                text.error()));
        return;
    }
    Core::Result<std::vector<OperatorToken>> tokens = ParseTokens(*text);
    if (!tokens.has_value())
    {
        section.AddError("tokens_file", fmt::format("{}: {}", config.tokensFile, Core::Describe(tokens.error())));
        return;
    }
    config.access.tokens = std::move(*tokens);
}

} // namespace

void ReadHttpConfig(const ConfigSection& root, const std::string& fileName, HttpConfig& config)
{
    const ConfigSection control = root.GetSection("operator");
    ReadListen(root.GetSection("http"), config.monitoring);
    ReadListen(control, config.control.http);
    ReadTokens(control, fileName, config.control);
    const Apps::Endpoint& listen = config.control.http.listen;
    if (listen == config.monitoring.listen && listen.port != 0)
    {
        control.AddError(
            "listen",
            fmt::format("{} is also the address of http.listen; give another port", Apps::MakeText(listen)));
    }
}

} // namespace ACS::Acsd
