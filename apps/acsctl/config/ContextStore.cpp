#include "config/ContextStore.hpp"

#include "common/config/TextFile.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>

namespace ACS::Acsctl
{

namespace
{

constexpr std::size_t LARGEST_CONFIG = 1024U * 1024U;
constexpr mode_t PRIVATE_FILE = S_IRUSR | S_IWUSR;
constexpr mode_t NOT_OF_OTHERS = S_IRWXG | S_IRWXO;

tl::unexpected<std::string> Fail(const std::string& path, int reason)
{
    return tl::make_unexpected(fmt::format("{}: {}", path, std::generic_category().message(reason)));
}

/// Writes the whole text; false with errno.
bool TryWriteAll(int file, std::string_view text)
{
    while (!text.empty())
    {
        const ssize_t count = ::write(file, text.data(), text.size());
        if (count < 0 && errno == EINTR)
        {
            continue;
        }
        if (count < 0)
        {
            return false;
        }
        text.remove_prefix(static_cast<std::size_t>(count));
    }
    return ::fsync(file) == 0;
}

/// Empty: the environment names no folder for it. Relative paths do not count, as the XDG specification demands.
std::string FindConfigPath(const Environment& environment)
{
    std::filesystem::path folder(environment.configHome.value_or(""));
    if (!folder.is_absolute())
    {
        folder = environment.home.value_or("");
        if (!folder.is_absolute())
        {
            return {};
        }
        folder /= ".config";
    }
    return folder / "acsctl" / "config.toml";
}

/// The file to replace: the target, if the path is a symbolic link.
std::filesystem::path FollowLinks(const std::string& path, std::error_code& error)
{
    std::error_code ignored; // there is no such file yet
    return std::filesystem::is_symlink(path, ignored) ? std::filesystem::canonical(path, error)
                                                      : std::filesystem::path(path);
}

} // namespace

ContextStore::ContextStore(const Environment& environment)
    : _path(FindConfigPath(environment))
{
}

tl::expected<Contexts, std::string> ContextStore::Load() const
{
    if (_path.empty())
    {
        return Contexts();
    }
    struct stat status = {};
    if (::stat(_path.c_str(), &status) != 0)
    {
        if (errno == ENOENT || errno == ENOTDIR)
        {
            return Contexts();
        }
        return Fail(_path, errno);
    }
    if (status.st_uid != ::geteuid())
    {
        return tl::make_unexpected(
            fmt::format("{} belongs to another user; acsctl reads only a file of its user", _path));
    }
    if ((status.st_mode & NOT_OF_OTHERS) != 0)
    {
        return tl::make_unexpected(
            fmt::format("other users can access {}, which may have tokens; run chmod 600 {}", _path, _path));
    }
    const tl::expected<std::string, std::string> text = Apps::ReadTextFileUpTo(_path, LARGEST_CONFIG);
    if (!text.has_value())
    {
        return tl::make_unexpected(fmt::format("{}: {}", _path, text.error()));
    }
    return ReadContexts(*text, _path);
}

tl::expected<void, std::string> ContextStore::Save(const Contexts& contexts) const
{
    const std::string text = WriteContexts(contexts);
    if (text.size() > LARGEST_CONFIG)
    {
        return tl::make_unexpected(fmt::format("{} would exceed {} bytes; nothing was written", _path, LARGEST_CONFIG));
    }
    std::error_code error;
    const std::filesystem::path target = FollowLinks(_path, error);
    if (error)
    {
        return Fail(_path, error.value());
    }
    std::filesystem::create_directories(target.parent_path(), error);
    if (error)
    {
        return Fail(target.parent_path(), error.value());
    }
    std::string temporary = target.string() + ".XXXXXX";
    const int file = ::mkostemp(temporary.data(), O_CLOEXEC); // mode 0600
    if (file < 0)
    {
        return Fail(temporary, errno);
    }
    const bool bWritten = TryWriteAll(file, text) && ::fchmod(file, PRIVATE_FILE) == 0;
    int reason = bWritten ? 0 : errno;
    ::close(file);
    if (reason == 0 && std::rename(temporary.c_str(), target.c_str()) != 0)
    {
        reason = errno;
    }
    if (reason != 0)
    {
        static_cast<void>(::unlink(temporary.c_str()));
        return Fail(target, reason);
    }
    return {};
}

const std::string& ContextStore::GetPath() const noexcept
{
    return _path;
}

tl::expected<std::string, std::string> ReadTokenFile(const std::string& path)
{
    const tl::expected<std::string, std::string> text = Apps::ReadTextFileUpTo(path, LONGEST_TOKEN);
    if (!text.has_value())
    {
        return tl::make_unexpected(fmt::format("{}: {}", path, text.error()));
    }
    struct stat status = {};
    if (::stat(path.c_str(), &status) == 0 && (status.st_mode & NOT_OF_OTHERS) != 0)
    {
        return tl::make_unexpected(fmt::format("other users can access {}; run chmod go-rwx {}", path, path));
    }
    std::string token = text->substr(0, text->find_first_of("\r\n"));
    if (!IsToken(token))
    {
        return tl::make_unexpected(fmt::format("{}: the first line is not a token", path));
    }
    return token;
}

bool IsToken(const std::string& text)
{
    return !text.empty() && text.size() <= LONGEST_TOKEN
        && std::ranges::all_of(text, [](char letter) { return letter > ' ' && letter < '\x7f'; });
}

} // namespace ACS::Acsctl
