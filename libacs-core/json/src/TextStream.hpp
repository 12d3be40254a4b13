#pragma once

#include <rapidjson/stream.h>

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace ACS::Json
{

/// RapidJSON's stream over a writable text: strings are unescaped in place. The leading part of a string without escapes,
/// usually all of it, is skipped eight bytes at a time.
class TextStream : public rapidjson::InsituStringStream
{
public:
    /// Number of zero bytes required after the text: its end, and one block of bytes that are checked together.
    static constexpr std::size_t PADDING = sizeof(std::uint64_t);

    using rapidjson::InsituStringStream::InsituStringStream;

private:
    static constexpr std::uint64_t ONES = 0x0101010101010101;
    static constexpr std::uint64_t HIGHS = 0x8080808080808080;
    static constexpr bool B_FIRST_IS_LOWEST = std::endian::native == std::endian::little;

    static constexpr char QUOTE = '"';
    static constexpr char BACKSLASH = '\\';
    static constexpr char FIRST_PRINTABLE = ' ';

public:
    /// Where what the reader takes next begins; never null. It asks behind the quote that opens a string, and at a number,
    /// whose text it takes from there.
    auto PutBegin()
    {
        Ch* const begin = src_;
        if (begin != head_ && begin[-1] == QUOTE)
        {
            SkipPlain();
        }
        dst_ = src_;
        return begin;
    }

private:
    /// The high bits of the bytes that are a quote, a backslash or a control character. Only the lowest is sure: the
    /// subtractions borrow from the bytes above it.
    [[nodiscard]] static std::uint64_t MarkSpecial(std::uint64_t bytes)
    {
        const std::uint64_t quotes = bytes ^ (ONES * QUOTE);
        const std::uint64_t backslashes = bytes ^ (ONES * BACKSLASH);
        return (((quotes - ONES) & ~quotes) | ((backslashes - ONES) & ~backslashes)
                | ((bytes - ONES * FIRST_PRINTABLE) & ~bytes))
            & HIGHS;
    }

    [[nodiscard]] static bool IsSpecial(char character)
    {
        return static_cast<unsigned char>(character) < static_cast<unsigned char>(FIRST_PRINTABLE) || character == QUOTE
            || character == BACKSLASH;
    }

    void SkipPlain()
    {
        std::uint64_t marks = 0;
        while (marks == 0)
        {
            std::uint64_t bytes = 0;
            std::memcpy(&bytes, src_, sizeof bytes);
            marks = MarkSpecial(bytes);
            src_ += marks == 0 ? sizeof bytes : 0;
        }
        if constexpr (B_FIRST_IS_LOWEST)
        {
            src_ += static_cast<std::size_t>(std::countr_zero(marks)) / 8;
        }
        while (!IsSpecial(*src_))
        {
            ++src_;
        }
    }
};

} // namespace ACS::Json

/// Small enough to be copied into the reader's loops, and RapidJSON 1.1.0 finds the text of a number only if it is.
template <>
struct rapidjson::StreamTraits<ACS::Json::TextStream> : rapidjson::StreamTraits<rapidjson::InsituStringStream>
{
};
