#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace ACS::OpenStream
{

/// What a session has to send: lines that must all go, in order, and at most one data line, which the next one replaces
/// as long as it has not left. One write is in flight at a time and never changes under it; buffers are reused.
class LineOutbox
{
    std::size_t _maximumBytes;
    std::string _lines;                ///< Waiting.
    std::string _data;                 ///< Waiting, replaceable, goes after the lines.
    std::string _sending;              ///< In flight.
    std::uint64_t _sentBytes = 0;      ///< Of lines, since the beginning.
    std::size_t _sendingBytes = 0;     ///< Of lines, in flight.
    std::size_t _dataLines = 0;        ///< Sealed among the waiting lines.
    std::size_t _dataLinesSending = 0; ///< Among what is in flight.
    bool _bSending = false;

public:
    /// The bound is on the waiting lines; the data line does not count.
    explicit LineOutbox(std::size_t maximumBytes);

    /// A string to append whole lines to, in place.
    [[nodiscard]] std::string& GetLines() noexcept;

    /// An empty string to write a data line to. True in bReplacedOut where a data line gave way that had not left.
    [[nodiscard]] std::string& BeginData(bool& bReplacedOut);

    /// The waiting data line joins the lines: what is appended later goes behind it, and nothing replaces it.
    void SealData();

    /// Takes everything that waits as the next write; empty where nothing waits or a write is in flight. Valid until
    /// CompleteSend or Reset.
    [[nodiscard]] std::string_view TakeForSend();

    /// The write in flight has left. Returns how many data lines were in it.
    std::size_t CompleteSend();

    /// Whether nothing waits. What is in flight does not count.
    [[nodiscard]] bool IsEmpty() const noexcept;
    [[nodiscard]] bool IsSending() const noexcept;
    [[nodiscard]] bool IsFull() const noexcept;

    /// A mark behind the lines so far; WasTaken(mark) once they are all in flight, WasSent(mark) once they have left.
    [[nodiscard]] std::uint64_t GetMark() const noexcept;
    [[nodiscard]] bool WasTaken(std::uint64_t mark) const noexcept;
    [[nodiscard]] bool WasSent(std::uint64_t mark) const noexcept;

    /// For a new connection.
    void Reset();
};

} // namespace ACS::OpenStream
