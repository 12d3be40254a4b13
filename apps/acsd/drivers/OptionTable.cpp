#include "drivers/OptionTableImpl.hpp"
#include <acs/acsd/OptionTable.hpp>

#include <fmt/format.h>

#include <utility>

namespace ACS::Acsd
{

OptionTable::OptionTable(std::shared_ptr<const Impl> impl) noexcept
    : _impl(std::move(impl))
{
}

OptionTable OptionTable::ReadText(std::string_view text, const std::string& fileName)
{
    const Apps::ConfigReader reader = Apps::ConfigReader::ReadText(text, fileName, {});
    return MakeOptionTable(reader, reader.GetRoot(), {}, std::make_shared<std::vector<std::string>>());
}

std::string OptionTable::GetString(const std::string& key) const
{
    return _impl->GetSection().GetString(key);
}

std::string OptionTable::GetString(const std::string& key, const std::string& fallback) const
{
    return _impl->GetSection().GetString(key, fallback);
}

std::string OptionTable::GetWord(const std::string& key, std::initializer_list<std::string_view> words) const
{
    return _impl->GetSection().GetWord(key, words);
}

std::string OptionTable::GetWord(
    const std::string& key,
    std::initializer_list<std::string_view> words,
    const std::string& fallback) const
{
    return _impl->GetSection().GetWord(key, words, fallback);
}

std::int64_t OptionTable::GetInteger(const std::string& key, std::int64_t min, std::int64_t max) const
{
    return _impl->GetSection().GetInteger(key, min, max);
}

std::int64_t OptionTable::GetInteger(const std::string& key, std::int64_t min, std::int64_t max, std::int64_t fallback)
    const
{
    return _impl->GetSection().GetInteger(key, min, max, fallback);
}

double OptionTable::GetNumber(const std::string& key, double min, double max) const
{
    return _impl->GetSection().GetNumber(key, min, max);
}

double OptionTable::GetNumber(const std::string& key, double min, double max, double fallback) const
{
    return _impl->GetSection().GetNumber(key, min, max, fallback);
}

bool OptionTable::IsEnabled(const std::string& key, bool bFallback) const
{
    return _impl->GetSection().IsEnabled(key, bFallback);
}

std::chrono::milliseconds OptionTable::GetDuration(
    const std::string& key,
    std::chrono::milliseconds min,
    std::chrono::milliseconds max,
    std::chrono::milliseconds fallback) const
{
    return _impl->GetSection().GetDuration(key, min, max, fallback);
}

TcpAddress OptionTable::GetTcpAddress(const std::string& key) const
{
    const Apps::ConfigSection section = _impl->GetSection();
    const std::string text = section.GetString(key);
    const Core::Result<Apps::Url> url = Apps::ParseURL(text, {Apps::EUrlScheme::Tcp});
    // The default port of the scheme is that of Hi6 controllers.
    const bool bPort = text.find_last_of(":]") > text.find("://") && !text.ends_with(']');
    if (!url.has_value() || !bPort)
    {
        section.AddError(key, fmt::format("expected tcp://HOST:PORT, found '{}'", text));
        return {};
    }
    return {url->peer.host, url->peer.port};
}

std::vector<std::string> OptionTable::GetStringList(const std::string& key) const
{
    return _impl->GetSection().GetStringList(key);
}

OptionTable OptionTable::GetTable(const std::string& name) const
{
    return MakeOptionTable(_impl->reader, _impl->GetSection().GetSection(name), {}, _impl->warnings);
}

std::vector<std::string> OptionTable::GetNames() const
{
    return _impl->GetSection().GetNames();
}

bool OptionTable::HasKey(const std::string& key) const
{
    return _impl->GetSection().HasKey(key);
}

void OptionTable::AddError(const std::string& key, const std::string& text) const
{
    _impl->GetSection().AddError(key, text);
}

void OptionTable::AddWarning(const std::string& key, const std::string& text) const
{
    const std::string_view separator = key.empty() || _impl->path.empty() ? "" : ".";
    _impl->warnings->push_back(fmt::format("{}{}{}: {}", _impl->path, separator, key, text));
}

const std::string& OptionTable::GetPath() const noexcept
{
    return _impl->path;
}

std::vector<std::string> OptionTable::GetErrors() const
{
    return _impl->reader.GetErrors();
}

std::vector<std::string> OptionTable::GetWarnings() const
{
    return *_impl->warnings;
}

OptionTable MakeOptionTable(
    const Apps::ConfigReader& reader,
    Apps::ConfigSection parent,
    std::string name,
    std::shared_ptr<std::vector<std::string>> warnings)
{
    return OptionTable(
        std::make_shared<const OptionTable::Impl>(reader, std::move(parent), std::move(name), std::move(warnings)));
}

} // namespace ACS::Acsd
