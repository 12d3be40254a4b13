#include "config/HttpConfig.hpp"

#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <algorithm>

namespace ACS::Acsd
{

namespace
{

using Apps::ConfigSection;

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

} // namespace

void ReadHttpConfig(const ConfigSection& root, HttpConfig& config)
{
    const ConfigSection control = root.GetSection("operator");
    ReadListen(root.GetSection("http"), config.monitoring);
    ReadListen(control, config.control);
    if (config.control.listen == config.monitoring.listen && config.control.listen.port != 0)
    {
        control.AddError(
            "listen",
            fmt::format(
                "{} is also the address of http.listen; give another port",
                Apps::MakeText(config.control.listen)));
    }
}

} // namespace ACS::Acsd
