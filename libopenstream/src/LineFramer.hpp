#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::OpenStream
{

/// Splits a stream of bytes into lines. A line that is entirely within one input is not copied. Blank lines are skipped, and
/// a carriage return before the line end is removed.
///
///     framer.Feed(bytes);
///     while (const auto line = framer.TakeLineOrNull()) { … }
///     framer.Keep();
class LineFramer
{
    std::size_t _maximumLine;
    std::string _kept;         ///< Bytes kept from earlier inputs.
    std::size_t _keptRead = 0; ///< Number of them that were returned.
    std::size_t _scanned = 0;  ///< Number of them that contain no line end.
    std::string_view _input;
    bool _bOverflown = false;

public:
    /// Maximum number of bytes of a line without its end.
    explicit LineFramer(std::size_t maximumLine);

    /// Adds bytes, which must stay valid until Keep, or until TakeLineOrNull returns nullopt.
    void Feed(std::string_view bytes);

    /// The next line; nullopt if more bytes are needed, and always after an overflow. Valid until the next call.
    [[nodiscard]] std::optional<std::string_view> TakeLineOrNull();

    /// Copies the bytes that were not returned yet, so that the input may be released.
    void Keep();

    /// Whether a line exceeded the maximum. The stream is unusable then.
    [[nodiscard]] bool HasOverflown() const noexcept;

    /// Whether there is an incomplete line.
    [[nodiscard]] bool HasPartialLine() const noexcept;

    /// Discards everything, for a new connection.
    void Reset();

private:
    [[nodiscard]] std::optional<std::string_view> TakeRawLineOrNull();
    [[nodiscard]] std::optional<std::string_view> CutKeptOrNull();
    void KeepPartialLine();
};

} // namespace ACS::OpenStream
