#include "common/TextFile.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <fstream>
#include <system_error>

namespace ACS::Apps
{

namespace
{

constexpr std::size_t CHUNK_BYTES = 65'536;

} // namespace

tl::expected<std::string, std::string> ReadTextFile(const std::string& path)
{
    errno = 0;
    std::ifstream file(path, std::ios::binary);
    std::string text;
    std::array<char, CHUNK_BYTES> chunk{};
    while (file && text.size() <= MAX_TEXT_FILE_BYTES)
    {
        // A folder can be opened, not read.
        file.read(chunk.data(), chunk.size());
        text.append(chunk.data(), static_cast<std::size_t>(file.gcount()));
    }
    if (text.size() > MAX_TEXT_FILE_BYTES)
    {
        return tl::make_unexpected(fmt::format("it is longer than {} bytes", MAX_TEXT_FILE_BYTES));
    }
    if (!file.is_open() || !file.eof() || file.bad())
    {
        return tl::make_unexpected(std::generic_category().message(errno != 0 ? errno : EIO));
    }
    return text;
}

} // namespace ACS::Apps
