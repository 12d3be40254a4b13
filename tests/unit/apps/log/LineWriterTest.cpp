#include "common/log/LineWriter.hpp"

#include "Catch.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <fcntl.h>
#include <optional>
#include <poll.h>
#include <sstream>
#include <string>
#include <unistd.h>

namespace Apps = ACS::Apps;

namespace
{

constexpr std::size_t QUEUE_BYTES = 8192;
constexpr std::size_t PIPE_BYTES = 65'536;
constexpr int PATIENCE_MILLISECONDS = 10'000;
constexpr const char* MISSING_END = " lines are missing";

std::string DescribeDropped(std::uint64_t count)
{
    return fmt::format("{} lines are missing\n", count);
}

/// What was read from a pipe.
struct Received
{
    std::string text;
    std::uint64_t lines = 0; ///< Those that were written.
    std::size_t bytes = 0;   ///< Of these lines.
    std::uint64_t dropped = 0;

    /// Counts the lines of the text that is complete.
    void Count()
    {
        lines = 0;
        bytes = 0;
        dropped = 0;
        std::istringstream stream(text.substr(0, text.rfind('\n') + 1));
        for (std::string line; std::getline(stream, line);)
        {
            if (line.ends_with(MISSING_END))
            {
                dropped += std::stoull(line);
                continue;
            }
            ++lines;
            bytes += line.size() + 1;
        }
    }
};

struct Pipe
{
    int reader = -1;
    int writer = -1;

    Pipe()
    {
        std::array<int, 2> ends{};
        REQUIRE(pipe2(ends.data(), O_CLOEXEC) == 0);
        reader = ends[0];
        writer = ends[1];
    }

    Pipe(const Pipe&) = delete;
    Pipe& operator=(const Pipe&) = delete;

    ~Pipe()
    {
        close(reader);
        CloseWriter();
    }

    void CloseWriter()
    {
        if (writer >= 0)
        {
            close(writer);
            writer = -1;
        }
    }

    /// Until each of the lines was received or reported as dropped.
    [[nodiscard]] Received ReadUntilCounted(std::uint64_t lines) const
    {
        Received received;
        std::array<char, 4096> buffer{};
        for (received.Count(); received.lines + received.dropped < lines; received.Count())
        {
            pollfd readable{reader, POLLIN, 0};
            REQUIRE(poll(&readable, 1, PATIENCE_MILLISECONDS) == 1);
            const ssize_t count = read(reader, buffer.data(), buffer.size());
            REQUIRE(count > 0);
            received.text.append(buffer.data(), static_cast<std::size_t>(count));
        }
        CHECK(received.lines + received.dropped == lines);
        return received;
    }

    /// Until the end of the pipe.
    [[nodiscard]] std::string ReadAll() const
    {
        std::string text;
        std::array<char, 4096> buffer{};
        for (ssize_t count = read(reader, buffer.data(), buffer.size()); count > 0;
             count = read(reader, buffer.data(), buffer.size()))
        {
            text.append(buffer.data(), static_cast<std::size_t>(count));
        }
        return text;
    }
};

/// Writes numbered lines until the first is dropped, and returns how many there were with it.
std::uint64_t FillUp(Apps::LineWriter& writer)
{
    std::uint64_t count = 0;
    while (writer.GetDropped() == 0)
    {
        writer.Write(fmt::format("line {}\n", ++count));
    }
    return count;
}

} // namespace

TEST_CASE("Lines are written in their order, the last before the writer ends")
{
    Pipe pipe;
    std::string expected;
    {
        Apps::LineWriter writer(pipe.writer, DescribeDropped);
        for (int i = 0; i < 100; ++i)
        {
            const std::string line = fmt::format("line {}\n", i);
            writer.Write(line);
            expected += line;
        }
    }
    pipe.CloseWriter();
    CHECK(pipe.ReadAll() == expected);
}

TEST_CASE(
    "A pipe that is not read does not stop the caller: lines are dropped, and their number is written once it is read")
{
    Pipe pipe;
    std::optional<Apps::LineWriter> writer;
    writer.emplace(pipe.writer, DescribeDropped, QUEUE_BYTES);
    std::uint64_t written = FillUp(*writer);
    for (const std::uint64_t end = written + 99; written < end; ++written)
    {
        writer->Write(std::string(QUEUE_BYTES - 1, 'x') + '\n');
    }
    // Each line is written or counted; the writer's thread may have made room between two of them.
    const Received received = pipe.ReadUntilCounted(written);
    CHECK(received.dropped > 0);
    CHECK(received.dropped == writer->GetDropped());
    CHECK(received.bytes <= PIPE_BYTES + 2 * QUEUE_BYTES); // nothing was read before: the pipe and two queues
    CHECK(received.text.starts_with("line 1\nline 2\n"));
    writer->Write("after it\n");
    writer.reset();
    pipe.CloseWriter();
    CHECK(pipe.ReadAll() == "after it\n");
}

TEST_CASE("A writer ends although its pipe is not read")
{
    const Pipe pipe;
    Apps::LineWriter writer(pipe.writer, DescribeDropped, QUEUE_BYTES);
    FillUp(writer);
    SUCCEED("the destructor returns");
}

TEST_CASE("A pipe without a reader drops the lines and does not end the process")
{
    Pipe pipe;
    close(pipe.reader);
    pipe.reader = -1;
    Apps::LineWriter writer(pipe.writer, DescribeDropped);
    while (writer.GetDropped() < 2)
    {
        writer.Write("lost\n");
    }
    CHECK(writer.GetDropped() >= 2);
}
