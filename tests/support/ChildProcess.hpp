#pragma once

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <fcntl.h>
#include <optional>
#include <poll.h>
#include <stdexcept>
#include <string>
#include <string_view>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <unistd.h>
#include <vector>

namespace ACS::Testing
{

/// A program that a test runs. Its output and errors come through one pipe. It is killed with the object, and by the
/// kernel if the test itself ends.
class ChildProcess
{
    using Clock = std::chrono::steady_clock;

    static constexpr std::size_t CHUNK = 4096;
    static constexpr int EXEC_FAILED = 127;

    pid_t _processID = -1;
    int _output = -1;
    std::string _text;
    std::optional<int> _exitCode;

public:
    /// The first argument is the program: a path, or a name that is searched in PATH.
    explicit ChildProcess(std::vector<std::string> arguments)
    {
        std::vector<char*> pointers;
        pointers.reserve(arguments.size() + 1);
        for (std::string& argument : arguments)
        {
            pointers.push_back(argument.data());
        }
        pointers.push_back(nullptr);
        std::array<int, 2> ends{};
        if (pipe2(ends.data(), O_CLOEXEC) != 0)
        {
            throw std::runtime_error("cannot make a pipe");
        }
        _processID = fork();
        if (_processID == 0)
        {
            prctl(PR_SET_PDEATHSIG, SIGKILL);
            dup2(ends[1], STDOUT_FILENO);
            dup2(ends[1], STDERR_FILENO);
            execvp(pointers.front(), pointers.data());
            _exit(EXEC_FAILED);
        }
        close(ends[1]);
        _output = ends[0];
        if (_processID < 0)
        {
            close(_output);
            throw std::runtime_error("cannot start a process");
        }
    }

    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;

    ~ChildProcess()
    {
        Signal(SIGKILL);
        WaitForExitOrNull(std::chrono::seconds(10));
        close(_output);
    }

    /// Reads its output until the text has appeared; false if the program has ended or the time has passed.
    [[nodiscard]] bool TryWaitForText(std::string_view part, std::chrono::milliseconds timeout)
    {
        const Clock::time_point deadline = Clock::now() + timeout;
        while (_text.find(part) == std::string::npos)
        {
            if (!IsReadyBefore(_output, deadline) || !TryRead())
            {
                return false;
            }
        }
        return true;
    }

    /// Reads to the end of its output, and returns its exit code, or 128 plus the signal that ended it; nullopt if
    /// it still runs after the time.
    std::optional<int> WaitForExitOrNull(std::chrono::milliseconds timeout)
    {
        if (_exitCode.has_value())
        {
            return _exitCode;
        }
        const Clock::time_point deadline = Clock::now() + timeout;
        while (IsReadyBefore(_output, deadline) && TryRead())
        {
        }
        // The number, because the header of glibc 2.36 declares the function for C only.
        const int handle = static_cast<int>(syscall(SYS_pidfd_open, _processID, 0));
        const bool bEnded = handle >= 0 && IsReadyBefore(handle, deadline);
        close(handle);
        int status = 0;
        if (bEnded && waitpid(_processID, &status, 0) == _processID)
        {
            _exitCode = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
        }
        return _exitCode;
    }

    void Signal(int signal) const
    {
        if (!_exitCode.has_value())
        {
            kill(_processID, signal);
        }
    }

    [[nodiscard]] pid_t GetProcessID() const noexcept
    {
        return _processID;
    }

    /// All output that was read so far.
    [[nodiscard]] const std::string& GetText() const noexcept
    {
        return _text;
    }

private:
    [[nodiscard]] static bool IsReadyBefore(int descriptor, Clock::time_point deadline)
    {
        const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(deadline - Clock::now());
        pollfd waited{descriptor, POLLIN, 0};
        return poll(&waited, 1, left.count() > 0 ? static_cast<int>(left.count()) : 0) > 0;
    }

    [[nodiscard]] bool TryRead()
    {
        std::array<char, CHUNK> chunk{};
        const ssize_t count = read(_output, chunk.data(), chunk.size());
        if (count > 0)
        {
            _text.append(chunk.data(), static_cast<std::size_t>(count));
        }
        return count > 0;
    }
};

} // namespace ACS::Testing
