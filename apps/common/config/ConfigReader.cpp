#include "common/config/ConfigReader.hpp"

#include "common/config/ConfigDocument.hpp"
#include "common/config/TextFile.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <utility>

namespace ACS::Apps
{

namespace
{

/// Limited, because a program that reloads the file (SIGHUP) is blocked while it reads.
constexpr std::size_t MAX_CONFIG_BYTES = 4U * 1024U * 1024U;

} // namespace

ConfigReader::ConfigReader(std::shared_ptr<ConfigDocument> document)
    : _document(std::move(document))
{
}

ConfigReader ConfigReader::ReadFile(const std::string& fileName, const std::vector<std::string>& overrides)
{
    const tl::expected<std::string, std::string> text = ReadTextFileUpTo(fileName, MAX_CONFIG_BYTES);
    if (!text.has_value())
    {
        return ConfigReader(ConfigDocument::MakeUnreadable(
            fileName,
            fmt::format("cannot be read ({}); give the path of a configuration file", text.error())));
    }
    return ReadText(*text, fileName, overrides);
}

ConfigReader ConfigReader::ReadText(
    std::string_view text,
    const std::string& fileName,
    const std::vector<std::string>& overrides)
{
    auto document = std::make_shared<ConfigDocument>(text, fileName);
    for (const std::string& override : overrides)
    {
        document->Override(override);
    }
    return ConfigReader(std::move(document));
}

ConfigSection ConfigReader::GetRoot() const
{
    return {_document, &_document->GetRoot(), {}};
}

void ConfigReader::AddError(const std::string& path, const std::string& text) const
{
    _document->AddError(_document->FindNearestOrNull(path), path, text);
}

std::vector<std::string> ConfigReader::GetErrors() const
{
    return _document->MakeConfigErrors();
}

std::map<std::string, std::string> ConfigReader::GetValues() const
{
    return _document->MakeValues();
}

} // namespace ACS::Apps
