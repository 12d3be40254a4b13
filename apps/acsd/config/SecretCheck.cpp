#include "config/SecretCheck.hpp"

#include <fmt/format.h>

#include <sys/stat.h>

namespace ACS::Acsd
{

namespace
{

bool IsOfThisMachine(const std::string& host)
{
    return host == "localhost" || host == "::1" || host.starts_with("127.");
}

bool IsReadableByAll(const std::string& path)
{
    struct stat status = {};
    return ::stat(path.c_str(), &status) == 0 && (status.st_mode & S_IROTH) != 0;
}

} // namespace

void CheckSecretFile(const Apps::ConfigSection& section, const std::string& key, const std::string& path)
{
    if (IsReadableByAll(path))
    {
        section.AddError(key, fmt::format("every user of this machine can read {}; run chmod o-rwx {}", path, path));
    }
}

void WarnOfReadableConfig(const std::string& key, const std::string& fileName, std::vector<std::string>& warnings)
{
    if (IsReadableByAll(fileName))
    {
        warnings.push_back(
            fmt::format("{}: every user of this machine can read {}; run chmod o-rwx {}", key, fileName, fileName));
    }
}

void WarnOfPlainSecret(
    const std::string& key,
    const Apps::Url& url,
    std::string_view encryptedScheme,
    std::vector<std::string>& warnings)
{
    if (!Apps::IsSecure(url.scheme) && !url.peer.host.empty() && !IsOfThisMachine(url.peer.host))
    {
        warnings.push_back(
            fmt::format("{}: it is sent to {} unencrypted; use {}://", key, url.peer.host, encryptedScheme));
    }
}

} // namespace ACS::Acsd
