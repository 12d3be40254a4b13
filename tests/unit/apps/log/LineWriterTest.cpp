#include "common/log/LineWriter.hpp"

#include "Catch.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <fcntl.h>
#include <optional>
#include <string>
#include <unistd.h>

namespace Apps = ACS::Apps;

namespace
{

constexpr std::size_t QUEUE_BYTES = 8192;

std::string DescribeDropped(std::uint64_t count)
{
    return fmt::format("{} lines are missing\n", count);
}

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
    const std::uint64_t count = FillUp(*writer);
    const std::uint64_t more = 99;
    for (std::uint64_t i = 0; i < more; ++i)
    {
        writer->Write(std::string(QUEUE_BYTES, 'x'));
    }
    const std::uint64_t dropped = writer->GetDropped();
    CHECK(dropped == 1 + more);
    // What waits is at most the pipe and two queues.
    CHECK(count < (64UL * 1024UL + 3 * QUEUE_BYTES) / std::string_view("line 1\n").size());

    std::string text;
    const std::string last = DescribeDropped(dropped);
    std::array<char, 4096> buffer{};
    while (!text.ends_with(last))
    {
        const ssize_t bytes = read(pipe.reader, buffer.data(), buffer.size());
        REQUIRE(bytes > 0);
        text.append(buffer.data(), static_cast<std::size_t>(bytes));
    }
    CHECK(text.starts_with("line 1\nline 2\n"));
    CHECK(text.find(fmt::format("line {}\n", count - 1)) != std::string::npos);
    CHECK(text.find(fmt::format("line {}\n", count)) == std::string::npos);
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
