#pragma once

#include "ChildProcess.hpp"
#include "TemporaryFolder.hpp"

#include <arpa/inet.h>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <memory>
#include <netinet/in.h>
#include <stdexcept>
#include <string>
#include <sys/socket.h>
#include <unistd.h>

namespace ACS::Testing
{

/// A port of 127.0.0.1 that no program uses at the moment.
inline std::uint16_t FindFreePort()
{
    const int probe = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t length = sizeof(address);
    auto* const generic = reinterpret_cast<sockaddr*>(&address); // the type of the socket interface
    const bool bFound = bind(probe, generic, length) == 0 && getsockname(probe, generic, &length) == 0;
    close(probe);
    if (!bFound)
    {
        throw std::runtime_error("no free port on 127.0.0.1");
    }
    return ntohs(address.sin_port);
}

/// The mosquitto of Debian on a free port of 127.0.0.1, with its own configuration and folder. Ends with the
/// object.
class MosquittoBroker
{
    static constexpr int MAX_ATTEMPTS = 10;
    static constexpr std::chrono::seconds START_TIMEOUT{10};

    TemporaryFolder _folder;
    std::string _settings;
    std::uint16_t _port = 0;
    std::unique_ptr<ChildProcess> _process;

public:
    /// The settings are further lines of its configuration file.
    explicit MosquittoBroker(std::string settings = "allow_anonymous true\n")
        : _settings(std::move(settings))
    {
        for (int i = 0; i < MAX_ATTEMPTS && _process == nullptr; ++i)
        {
            _port = FindFreePort(); // another program may use the port before mosquitto does
            TryStart();
        }
        if (_process == nullptr)
        {
            throw std::runtime_error("mosquitto does not start: is it installed?");
        }
    }

    MosquittoBroker(const MosquittoBroker&) = delete;
    MosquittoBroker& operator=(const MosquittoBroker&) = delete;
    ~MosquittoBroker() = default;

    [[nodiscard]] std::uint16_t GetPort() const noexcept
    {
        return _port;
    }

    [[nodiscard]] std::string GetURL() const
    {
        return "mqtt://127.0.0.1:" + std::to_string(_port);
    }

    [[nodiscard]] const std::filesystem::path& GetFolder() const noexcept
    {
        return _folder.GetPath();
    }

    [[nodiscard]] pid_t GetProcessID() const noexcept
    {
        return _process->GetProcessID();
    }

    /// Like a power loss: clients get no message, nothing is stored.
    void Kill()
    {
        _process.reset();
    }

    /// Starts it on the same port, after Kill.
    void Restart()
    {
        TryStart();
        if (_process == nullptr)
        {
            throw std::runtime_error("mosquitto does not start again");
        }
    }

private:
    void TryStart()
    {
        const std::filesystem::path configuration = _folder.GetPath() / "mosquitto.conf";
        std::ofstream file(configuration);
        if (getuid() == 0)
        {
            file << "user root\n"; // otherwise it changes to its own user, who cannot read this folder
        }
        file << "listener " << _port << " 127.0.0.1\npersistence false\nlog_dest stderr\nlog_type error\n"
             << "log_type information\n"
             << _settings;
        file.close();
        const std::string system = "/usr/sbin/mosquitto"; // not in the PATH of every user
        const std::string program = std::filesystem::exists(system) ? system : "mosquitto";
        _process = std::make_unique<ChildProcess>(std::vector<std::string>{program, "-c", configuration.string()});
        if (!_process->TryWaitForText("running", START_TIMEOUT))
        {
            _process.reset();
        }
    }
};

} // namespace ACS::Testing
