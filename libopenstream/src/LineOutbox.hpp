#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace ACS::OpenStream
{

/// The output of a session: lines that are all sent, in order, and at most one data line, which the next one replaces until
/// it is sent. One write is in flight at a time, and its buffer does not change; buffers are reused.
class LineOutbox
{
    std::size_t _maximumBytes;
    std::string _lines;                ///< Waiting.
    std::string _data;                 ///< Waiting, replaceable, sent after the lines.
    std::string _sending;              ///< In flight.
    std::uint64_t _sentBytes = 0;      ///< Of lines, in total.
    std::size_t _sendingBytes = 0;     ///< Of lines, in flight.
    std::size_t _dataLines = 0;        ///< Sealed among the waiting lines.
    std::size_t _dataLinesSending = 0; ///< In flight.
    bool _bSending = false;

public:
    /// Maximum number of bytes of the waiting lines, without the data line.
    explicit LineOutbox(std::size_t maximumBytes);

    /// A string to append whole lines to, in place.
    [[nodiscard]] std::string& GetLines() noexcept;

    /// An empty string to write a data line to. bReplacedOut: whether it replaces a data line that was not sent.
    [[nodiscard]] std::string& BeginData(bool& bReplacedOut);

    /// Moves the waiting data line to the lines: it is not replaced any more, and later lines follow it.
    void SealData();

    /// Returns everything that waits as the next write; empty if nothing waits or a write is in flight. Valid until
    /// CompleteSend or Reset.
    [[nodiscard]] std::string_view TakeForSend();

    /// The write in flight is complete. Returns the number of its data lines.
    std::size_t CompleteSend();

    /// Whether nothing waits, apart from the write in flight.
    [[nodiscard]] bool IsEmpty() const noexcept;
    [[nodiscard]] bool IsSending() const noexcept;
    [[nodiscard]] bool IsFull() const noexcept;

    /// A mark after the lines so far: WasTaken(mark) once they are all in flight, WasSent(mark) once they were written.
    [[nodiscard]] std::uint64_t GetMark() const noexcept;
    [[nodiscard]] bool WasTaken(std::uint64_t mark) const noexcept;
    [[nodiscard]] bool WasSent(std::uint64_t mark) const noexcept;

    /// For a new connection.
    void Reset();
};

} // namespace ACS::OpenStream
