#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

namespace ACS::Apps
{

/// Writes lines to a descriptor on a thread of its own: a pipe that is not read, or a disk that hangs, does not stop the
/// caller. Lines that come while the queue is full are dropped and counted; the number is written when there is room again.
/// The last lines before a crash of the process can be lost. From any thread.
class LineWriter final
{
public:
    /// Of lines that wait; as many bytes again can be under way.
    static constexpr std::size_t MAX_BYTES = 1024UL * 1024UL;
    /// The line, with its end, that reports this number of dropped lines. Called on the writer's thread.
    using DescribeDropped = std::function<std::string(std::uint64_t)>;

private:
    struct Shared;
    std::shared_ptr<Shared> _shared;

public:
    /// Does not close the descriptor.
    LineWriter(int descriptor, DescribeDropped describe, std::size_t maximumBytes = MAX_BYTES);
    LineWriter(const LineWriter&) = delete;
    LineWriter& operator=(const LineWriter&) = delete;
    /// Waits for the lines in the queue, for at most one second. What then still waits is lost.
    ~LineWriter();

    /// The line has its end.
    void Write(std::string_view line);
    /// Waits until nothing waits, for at most one second.
    void Flush();
    [[nodiscard]] std::uint64_t GetDropped() const;
};

} // namespace ACS::Apps
