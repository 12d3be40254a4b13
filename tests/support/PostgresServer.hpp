#pragma once

#include "ChildProcess.hpp"
#include "MosquittoBroker.hpp"
#include "TemporaryFolder.hpp"

#include <chrono>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <unistd.h>
#include <vector>

namespace ACS::Testing
{

/// The PostgreSQL of Debian on a free port of 127.0.0.1, with its own data. Ends with the object. It does not run as root: a
/// test that does starts it as the user postgres.
class PostgresServer
{
    static constexpr int MAX_ATTEMPTS = 10;
    static constexpr std::chrono::seconds START_TIMEOUT{60};

    TemporaryFolder _folder;
    std::vector<std::string> _settings;
    std::uint16_t _port = 0;
    std::unique_ptr<ChildProcess> _process;

public:
    /// Each setting is "name=value".
    explicit PostgresServer(std::vector<std::string> settings = {})
        : _settings(std::move(settings))
    {
        GiveToServer(_folder.GetPath().string());
        Run(MakeCommand(
            {GetProgram("initdb"),
             "-D",
             GetData(),
             "-U",
             "acsd",
             "-A",
             "trust",
             "-E",
             "UTF8",
             "--locale=C",
             "--no-sync"}));
        for (int i = 0; i < MAX_ATTEMPTS && _process == nullptr; ++i)
        {
            _port = FindFreePort(); // another program may use the port before the server does
            TryStart();
        }
        if (_process == nullptr)
        {
            throw std::runtime_error("PostgreSQL does not start");
        }
    }

    /// Lets the user of the server read a file or a folder with its files.
    static void GiveToServer(const std::string& path)
    {
        if (geteuid() == 0)
        {
            Run({"chown", "-R", "postgres:", path});
        }
    }

    [[nodiscard]] std::uint16_t GetPort() const noexcept
    {
        return _port;
    }

    [[nodiscard]] static std::string GetURL(const std::string& database, std::uint16_t port)
    {
        return "postgresql://acsd@127.0.0.1:" + std::to_string(port) + "/" + database;
    }

    [[nodiscard]] std::string GetURL(const std::string& database = "postgres") const
    {
        return GetURL(database, _port);
    }

    /// Statements separated by semicolons. Returns what psql prints, without headers.
    // NOLINTNEXTLINE(modernize-use-nodiscard): most statements have no result
    std::string Execute(const std::string& sql, const std::string& database = "postgres") const
    {
        return Run({"psql", "-X", "-q", "-A", "-t", "-v", "ON_ERROR_STOP=1", "-c", sql, GetURL(database)});
    }

    /// The server ends without warning, as with the power. Its data has what was committed.
    void Kill()
    {
        _process->Signal(SIGKILL);
        _process->WaitForExitOrNull(START_TIMEOUT);
        _process.reset();
    }

    void Start()
    {
        TryStart();
        if (_process == nullptr)
        {
            throw std::runtime_error("PostgreSQL does not start again");
        }
    }

private:
    [[nodiscard]] std::string GetData() const
    {
        return (_folder.GetPath() / "data").string();
    }

    /// Debian does not put the programs of the server into PATH.
    [[nodiscard]] static std::string GetProgram(const std::string& name)
    {
        for (const auto& version : std::filesystem::directory_iterator("/usr/lib/postgresql"))
        {
            const std::filesystem::path program = version.path() / "bin" / name;
            if (std::filesystem::exists(program))
            {
                return program.string();
            }
        }
        throw std::runtime_error("there is no " + name + ": run scripts/setup");
    }

    [[nodiscard]] static std::vector<std::string> MakeCommand(std::vector<std::string> command)
    {
        if (geteuid() == 0)
        {
            const std::vector<std::string>
                prefix{"setpriv", "--reuid=postgres", "--regid=postgres", "--clear-groups", "--pdeathsig=SIGKILL"};
            command.insert(command.begin(), prefix.begin(), prefix.end());
        }
        return command;
    }

    static std::string Run(std::vector<std::string> command)
    {
        const std::string name = command.front();
        ChildProcess process(std::move(command));
        if (process.WaitForExitOrNull(START_TIMEOUT) != 0)
        {
            throw std::runtime_error(name + " failed: " + process.GetText());
        }
        return process.GetText();
    }

    void TryStart()
    {
        std::vector<std::string> command{
            GetProgram("postgres"),
            "-D",
            GetData(),
            "-k",
            _folder.GetPath().string(),
            "-p",
            std::to_string(_port)};
        for (const std::string& setting : _settings)
        {
            command.emplace_back("-c");
            command.push_back(setting);
        }
        auto process = std::make_unique<ChildProcess>(MakeCommand(std::move(command)));
        if (process->TryWaitForText("ready to accept connections", START_TIMEOUT))
        {
            _process = std::move(process);
        }
    }
};

} // namespace ACS::Testing
