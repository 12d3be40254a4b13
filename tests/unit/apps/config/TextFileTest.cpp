#include "common/config/TextFile.hpp"

#include "Catch.hpp"
#include "common/config/ConfigReader.hpp"
#include "TemporaryFolder.hpp"

#include <fstream>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

namespace Apps = ACS::Apps;
using ACS::Testing::TemporaryFolder;

namespace
{

std::string MakeFile(const TemporaryFolder& folder, const std::string& content)
{
    std::string path = folder.GetPath() / "file";
    std::ofstream(path, std::ios::binary) << content;
    return path;
}

} // namespace

TEST_CASE("A regular file is read completely, also through a link and with zero bytes")
{
    const TemporaryFolder folder;
    const std::string content = std::string(200'000, 'x') + '\0' + "end";
    const std::string path = MakeFile(folder, content);
    const std::string link = folder.GetPath() / "link";
    std::filesystem::create_symlink(path, link);
    CHECK(Apps::ReadTextFile(path) == content);
    CHECK(Apps::ReadTextFile(link) == content);
    CHECK(Apps::ReadTextFile(MakeFile(folder, "")) == std::string());
}

TEST_CASE("Another file type is refused with its name, without blocking")
{
    const TemporaryFolder folder;
    const std::string pipe = folder.GetPath() / "pipe"; // has no writer
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    CHECK(Apps::ReadTextFile(pipe).error() == "it is a pipe; only regular files are read");
    CHECK(Apps::ReadTextFile("/dev/zero").error() == "it is a device; only regular files are read");
    CHECK(Apps::ReadTextFile(folder.GetPath()).error() == "Is a directory");
    CHECK(Apps::ReadTextFile(folder.GetPath() / "none").error() == "No such file or directory");

    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    const std::string socketPath = folder.GetPath() / "socket";
    REQUIRE(socketPath.size() < sizeof address.sun_path);
    socketPath.copy(&address.sun_path[0], socketPath.size());
    const int socket = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    REQUIRE(::bind(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0); // NOLINT: its signature
    CHECK(Apps::ReadTextFile(socketPath).error() == "it is a socket; only regular files are read");
    ::close(socket);
}

TEST_CASE("A file of the maximum size is read, a longer one is refused")
{
    const TemporaryFolder folder;
    const std::string path = MakeFile(folder, "12345678");
    CHECK(Apps::ReadTextFileUpTo(path, 8) == std::string("12345678"));
    CHECK(Apps::ReadTextFileUpTo(path, 7).error() == "it is longer than 7 bytes");
}

TEST_CASE("A configuration that is not a regular file of at most 4 MiB has this single error")
{
    const TemporaryFolder folder;
    const std::string pipe = folder.GetPath() / "pipe";
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    CHECK(
        Apps::ConfigReader::ReadFile(pipe, {}).GetErrors()
        == std::vector<std::string>{
            pipe
            + ": cannot be read (it is a pipe; only regular files are read); give the path of a configuration file"});
    const std::string path = MakeFile(folder, "# " + std::string(4U * 1024U * 1024U, 'x') + "\n");
    CHECK(
        Apps::ConfigReader::ReadFile(path, {}).GetErrors()
        == std::vector<std::string>{
            path + ": cannot be read (it is longer than 4194304 bytes); give the path of a configuration file"});
}
