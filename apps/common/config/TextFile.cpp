#include "common/config/TextFile.hpp"

#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstddef>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace ACS::Apps
{

namespace
{

constexpr std::size_t CHUNK_BYTES = 65'536;

/// An open file, closed at the end.
class Descriptor final
{
    int _number;

public:
    /// Opens without blocking: a FIFO without a writer would block the program indefinitely.
    explicit Descriptor(const std::string& path)
        : _number(::open(path.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC | O_NOCTTY)) // NOLINT: the system's signature
    {
    }

    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;

    ~Descriptor()
    {
        if (_number >= 0)
        {
            ::close(_number);
        }
    }

    [[nodiscard]] int GetNumber() const noexcept
    {
        return _number;
    }
};

tl::unexpected<std::string> FailForErrno()
{
    return tl::make_unexpected(std::generic_category().message(errno));
}

std::string DescribeKind(mode_t mode)
{
    if (S_ISDIR(mode))
    {
        return std::generic_category().message(EISDIR);
    }
    const char* kind = S_ISFIFO(mode) ? "a pipe" : S_ISSOCK(mode) ? "a socket" : "a device";
    return fmt::format("it is {}; only regular files are read", kind);
}

} // namespace

tl::expected<std::string, std::string> ReadTextFile(const std::string& path)
{
    return ReadTextFileUpTo(path, MAX_TEXT_FILE_BYTES);
}

tl::expected<std::string, std::string> ReadTextFileUpTo(const std::string& path, std::size_t maximumBytes)
{
    const Descriptor file(path);
    struct stat status = {};
    if (file.GetNumber() < 0)
    {
        // A socket cannot be opened and a device may have no driver: name the type of the file instead of the error.
        const int reason = errno;
        if (reason == ENXIO && ::stat(path.c_str(), &status) == 0)
        {
            return tl::make_unexpected(DescribeKind(status.st_mode));
        }
        return tl::make_unexpected(std::generic_category().message(reason));
    }
    if (::fstat(file.GetNumber(), &status) != 0)
    {
        return FailForErrno();
    }
    if (!S_ISREG(status.st_mode))
    {
        return tl::make_unexpected(DescribeKind(status.st_mode));
    }
    std::string text;
    std::array<char, CHUNK_BYTES> chunk{};
    while (text.size() <= maximumBytes)
    {
        const ssize_t count = ::read(file.GetNumber(), chunk.data(), chunk.size());
        if (count < 0 && errno == EINTR)
        {
            continue;
        }
        if (count < 0)
        {
            return FailForErrno();
        }
        if (count == 0)
        {
            return text;
        }
        text.append(chunk.data(), static_cast<std::size_t>(count));
    }
    return tl::make_unexpected(fmt::format("it is longer than {} bytes", maximumBytes));
}

} // namespace ACS::Apps
