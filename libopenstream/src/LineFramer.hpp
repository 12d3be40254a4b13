#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::OpenStream
{

/// Cuts a stream of bytes into lines, wherever the stream was split. A line that lies whole in the input is not copied.
/// Lines of blanks only are skipped, a carriage return before the line's end is dropped.
///
///     framer.Feed(bytes);
///     while (const auto line = framer.TakeLineOrNull()) { … }
///     framer.Keep();
class LineFramer
{
    std::size_t _maximumLine;
    std::string _kept;         ///< Bytes that outlived their Feed.
    std::size_t _keptRead = 0; ///< How many of them were handed out.
    std::size_t _scanned = 0;  ///< How many of them are known to hold no line end.
    std::string_view _input;
    bool _bOverflown = false;

    [[nodiscard]] std::optional<std::string_view> TakeRawLineOrNull();
    [[nodiscard]] std::optional<std::string_view> CutKeptOrNull();
    void KeepPartialLine();

public:
    /// The bound is on a line's bytes without its end.
    explicit LineFramer(std::size_t maximumLine);

    /// Gives further bytes, which must stay valid until Keep, or until TakeLineOrNull returns nullopt.
    void Feed(std::string_view bytes);

    /// The next whole line; nullopt where more bytes are needed, and for ever after an overflow. Valid until the next
    /// call.
    [[nodiscard]] std::optional<std::string_view> TakeLineOrNull();

    /// Copies what was not yet handed out, so that the input may go. Harmless where nothing is left.
    void Keep();

    /// Whether a line came that is longer than the bound. The stream cannot be trusted any more.
    [[nodiscard]] bool HasOverflown() const noexcept;

    /// Whether bytes wait that belong to no whole line yet.
    [[nodiscard]] bool HasPartialLine() const noexcept;

    /// Forgets everything, for a new connection.
    void Reset();
};

} // namespace ACS::OpenStream
