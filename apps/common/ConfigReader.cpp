#include "common/ConfigReader.hpp"

#include "common/ConfigDocument.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

namespace ACS::Apps
{

namespace
{

constexpr std::size_t CHUNK_BYTES = 4096;

/// 0, or the system's error number.
int ReadAll(const std::string& fileName, std::string& text)
{
    errno = 0;
    std::ifstream file(fileName, std::ios::binary);
    std::array<char, CHUNK_BYTES> chunk{};
    while (file)
    {
        // A folder can be opened, not read.
        file.read(chunk.data(), chunk.size());
        text.append(chunk.data(), static_cast<std::size_t>(file.gcount()));
    }
    const bool bReadToEnd = file.is_open() && file.eof() && !file.bad();
    if (bReadToEnd)
    {
        return 0;
    }
    return errno != 0 ? errno : EIO;
}

} // namespace

ConfigReader::ConfigReader(std::shared_ptr<ConfigDocument> document)
    : _document(std::move(document))
{
}

ConfigReader ConfigReader::ReadFile(const std::string& fileName, const std::vector<std::string>& overrides)
{
    std::string text;
    const int systemError = ReadAll(fileName, text);
    if (systemError != 0)
    {
        const std::string reason = std::generic_category().message(systemError);
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
