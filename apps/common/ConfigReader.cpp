#include "common/ConfigReader.hpp"

#include "common/ConfigDocument.hpp"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

namespace ACS::Apps
{

ConfigReader::ConfigReader(std::shared_ptr<ConfigDocument> document)
    : _document(std::move(document))
{
}

ConfigReader ConfigReader::ReadFile(const std::string& fileName, const std::vector<std::string>& overrides)
{
    std::ifstream file(fileName, std::ios::binary);
    std::string text;
    if (file)
    {
        text.assign(std::istreambuf_iterator<char>(file), {});
    }
    // A folder can be opened, not read.
    file.peek();
    if (!file.is_open() || file.bad())
    {
        const std::string reason = std::generic_category().message(errno);
        return ConfigReader(ConfigDocument::MakeUnreadable(
            fileName,
            fmt::format("cannot be read ({}); give the path of a configuration file", reason)));
    }
    return ReadText(text, fileName, overrides);
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

std::vector<std::string> ConfigReader::GetMistakes() const
{
    return _document->MakeMistakes();
}

} // namespace ACS::Apps
