#include "TextStream.hpp"
#include <acs/core/JsonText.hpp>
#include <acs/core/ParseNumber.hpp>
#include <acs/json/JsonDocument.hpp>

#include <fmt/format.h>
#include <rapidjson/error/en.h>
#include <rapidjson/reader.h>
#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Json
{

namespace
{

// Enough for a plan of 75 jobs, and little enough for a session to stay below 64 KiB.
constexpr std::size_t VALUE_POOL_BYTES = 24U * 1024U;
constexpr std::size_t STACK_POOL_BYTES = 12U * 1024U;
constexpr std::size_t FIRST_STACK_BYTES = 1024;
constexpr std::size_t LONGEST_FOUND = 40;
/// The encoding is checked before, several bytes at a time: RapidJSON would check each byte separately.
/// Numbers come as text: the full precision of RapidJSON 1.1.0 reads past its tables where a long fraction has a low
/// exponent, which any peer may send.
constexpr unsigned PARSE_FLAGS =
    rapidjson::kParseIterativeFlag | rapidjson::kParseNumbersAsStringsFlag | rapidjson::kParseInsituFlag;
constexpr unsigned LENIENT_FLAGS = PARSE_FLAGS | rapidjson::kParseCommentsFlag | rapidjson::kParseTrailingCommasFlag;

/// Whether a string contains a lone surrogate. RapidJSON refuses an escaped lone high surrogate, but writes a low one as
/// three bytes of invalid UTF-8. Nothing else results in such bytes, because it checks unescaped text.
bool HasHalfSurrogate(std::string_view text)
{
    constexpr char SURROGATE_LEAD = '\xED';
    for (std::size_t at = text.find(SURROGATE_LEAD); at != std::string_view::npos;
         at = text.find(SURROGATE_LEAD, at + 1))
    {
        if (at + 1 < text.size() && static_cast<unsigned char>(text[at + 1]) >= 0xA0U)
        {
            return true;
        }
    }
    return false;
}

/// Whether a text has more values than the limit, if it is JSON: each comma outside of a string precedes one. Such a text is
/// refused before it is copied and parsed. Other texts are counted exactly by the parse.
/// Whether a number that no double can represent is nearer to zero than to infinity.
bool IsSmall(std::string_view number)
{
    const std::size_t mantissaEnd = std::min(number.find_first_of("eE"), number.size());
    const std::string_view mantissa = number.substr(0, mantissaEnd);
    std::string_view exponent = number.substr(std::min(mantissaEnd + 1, number.size()));
    exponent.remove_prefix(exponent.starts_with('+') ? 1 : 0);
    const auto first = static_cast<std::ptrdiff_t>(std::min(mantissa.find_first_of("123456789"), mantissa.size()));
    const auto point = static_cast<std::ptrdiff_t>(std::min(mantissa.find('.'), mantissa.size()));
    const std::ptrdiff_t places = first < point ? point - first - 1 : point - first; // of the first digit
    const std::optional<std::int64_t> written =
        exponent.empty() ? std::optional(std::int64_t{0}) : Core::ParseNumberOrNull<std::int64_t>(exponent);
    return written.has_value() ? *written < -places : exponent.starts_with('-');
}

bool HasTooManyCommas(std::string_view text, std::size_t maximumValues)
{
    if (text.size() / 2 <= maximumValues) // a value and its comma
    {
        return false;
    }
    std::size_t commas = 0;
    bool bString = false;
    for (std::size_t at = 0; at < text.size() && commas < maximumValues; ++at)
    {
        const char sign = text[at];
        if (sign == '"')
        {
            bString = !bString;
        }
        else if (sign == '\\' && bString)
        {
            ++at;
        }
        else if (sign == ',' && !bString)
        {
            ++commas;
        }
    }
    return commas >= maximumValues;
}

/// Passes the parser's events on to the document, and ends the parse at a limit and at half a surrogate pair.
class StrictHandler
{
public:
    using Ch = char;

private:
    Document& _document;
    std::size_t _depth = 0;
    std::size_t _values = 0;
    const ParseLimits& _limits;
    const bool _bEscaped; ///< The text has escapes at all: without them there are no half pairs to look for.
    bool _bHalfSurrogate = false;
    bool _bNumberTooLarge = false;

public:
    StrictHandler(Document& document, const ParseLimits& limits, bool bEscaped)
        : _document(document),
          _limits(limits),
          _bEscaped(bEscaped)
    {
    }

    [[nodiscard]] bool HasFoundLargeNumber() const
    {
        return _bNumberTooLarge;
    }

    [[nodiscard]] bool HasTooManyValues() const
    {
        return _values > _limits.values;
    }

    [[nodiscard]] bool HasFoundHalfSurrogate() const
    {
        return _bHalfSurrogate;
    }

    bool Null()
    {
        return CanCount() && _document.Null();
    }

    bool Bool(bool bValue)
    {
        return CanCount() && _document.Bool(bValue);
    }

    bool Int(int value)
    {
        return CanCount() && _document.Int(value);
    }

    bool Uint(unsigned value)
    {
        return CanCount() && _document.Uint(value);
    }

    bool Int64(std::int64_t value)
    {
        return CanCount() && _document.Int64(value);
    }

    bool Uint64(std::uint64_t value)
    {
        return CanCount() && _document.Uint64(value);
    }

    bool Double(double value)
    {
        return CanCount() && _document.Double(value);
    }

    /// Text that follows JSON's grammar of a number.
    bool RawNumber(const char* text, rapidjson::SizeType length, bool /*bCopy*/)
    {
        if (!CanCount())
        {
            return false;
        }
        const std::string_view number(text, length);
        const bool bInteger =
            std::ranges::none_of(number, [](char sign) { return sign == '.' || sign == 'e' || sign == 'E'; });
        std::int64_t integer = 0;
        std::uint64_t positive = 0;
        if (bInteger && TryRead(number, integer))
        {
            return _document.Int64(integer);
        }
        if (bInteger && TryRead(number, positive))
        {
            return _document.Uint64(positive);
        }
        double value = 0.0;
        if (TryRead(number, value))
        {
            return _document.Double(value);
        }
        // Too small for a double is zero; too large has no value.
        const bool bSmall = IsSmall(number);
        _bNumberTooLarge = !bSmall;
        return bSmall && _document.Double(0.0);
    }

    bool String(const char* text, rapidjson::SizeType length, bool bCopy)
    {
        return CanCount() && IsWhole(text, length) && _document.String(text, length, bCopy);
    }

    bool StartObject()
    {
        return CanCount() && ++_depth <= _limits.depth && _document.StartObject();
    }

    bool Key(const char* text, rapidjson::SizeType length, bool bCopy)
    {
        return IsWhole(text, length) && _document.Key(text, length, bCopy);
    }

    bool EndObject(rapidjson::SizeType count)
    {
        --_depth;
        return _document.EndObject(count);
    }

    bool StartArray()
    {
        return CanCount() && ++_depth <= _limits.depth && _document.StartArray();
    }

    bool EndArray(rapidjson::SizeType count)
    {
        --_depth;
        return _document.EndArray(count);
    }

private:
    template <typename TNumber>
    [[nodiscard]] static bool TryRead(std::string_view text, TNumber& out)
    {
        const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
        return error == std::errc() && end == text.data() + text.size();
    }

    /// Counts one value more; whether it is within the limit.
    [[nodiscard]] bool CanCount()
    {
        return ++_values <= _limits.values;
    }

    [[nodiscard]] bool IsWhole(const char* text, rapidjson::SizeType length)
    {
        _bHalfSurrogate = _bEscaped && HasHalfSurrogate({text, length});
        return !_bHalfSurrogate;
    }
};

std::string_view SkipByteOrderMark(std::string_view text)
{
    constexpr std::string_view MARK = "\xEF\xBB\xBF";
    return text.substr(0, MARK.size()) == MARK ? text.substr(MARK.size()) : text;
}

/// Over a copy in the pool, as the strings of the document stay there.
TextStream MakeStream(std::string_view text, PoolAllocator& pool)
{
    char* const copy = static_cast<char*>(pool.Malloc(text.size() + TextStream::PADDING));
    std::memset(std::copy(text.begin(), text.end(), copy), 0, TextStream::PADDING);
    return TextStream(copy);
}

/// "byte 17", or "line 3, column 5" of a text with several lines. Both count bytes; the first line and column is 1.
std::string DescribePosition(std::string_view text, std::size_t offset)
{
    if (text.find('\n') == std::string_view::npos)
    {
        return fmt::format("byte {}", offset);
    }
    const std::string_view before = text.substr(0, offset);
    const std::size_t lineStart = before.rfind('\n') == std::string_view::npos ? 0 : before.rfind('\n') + 1;
    return fmt::format("line {}, column {}", 1 + std::ranges::count(before, '\n'), offset - lineStart + 1);
}

tl::unexpected<Core::Error> FailTooManyValues(const ParseLimits& limits)
{
    return Core::Fail(Core::ECoreError::TooLarge, {}, fmt::format("at most {} values", limits.values));
}

bool IsUtf8Continuation(char byte)
{
    return (static_cast<unsigned char>(byte) & 0xC0U) == 0x80U;
}

bool HasDuplicateNamesHere(const Value& object)
{
    std::vector<std::string_view> names;
    names.reserve(object.MemberCount());
    for (const auto& member : object.GetObject())
    {
        names.emplace_back(member.name.GetString(), member.name.GetStringLength());
    }
    std::ranges::sort(names);
    return std::ranges::adjacent_find(names) != names.end();
}

} // namespace

JsonDocument::JsonDocument()
    : _valueBuffer(std::make_unique_for_overwrite<char[]>(VALUE_POOL_BYTES)), // NOLINT(modernize-avoid-c-arrays)
      _stackBuffer(std::make_unique_for_overwrite<char[]>(STACK_POOL_BYTES)), // NOLINT(modernize-avoid-c-arrays)
      _valuePool(_valueBuffer.get(), VALUE_POOL_BYTES),
      _stackPool(_stackBuffer.get(), STACK_POOL_BYTES)
{
}

JsonDocument::~JsonDocument() = default;

Core::Result<const Value*> JsonDocument::Parse(std::string_view text, const ParseLimits& limits, bool bLenient)
{
    if (text.size() > limits.bytes)
    {
        return Core::Fail(
            Core::ECoreError::TooLarge,
            {},
            fmt::format("at most {} bytes", limits.bytes),
            fmt::format("{} bytes", text.size()));
    }
    const std::string_view body = SkipByteOrderMark(text);
    if (!bLenient && HasTooManyCommas(body, limits.values)) // a comment may have commas
    {
        return FailTooManyValues(limits);
    }
    if (!Core::JsonText::IsUtf8(body))
    {
        return Core::Fail(Core::ECoreError::InvalidJSON, {}, "JSON", "invalid UTF-8");
    }
    _document.reset();
    _valuePool.Clear();
    _stackPool.Clear();
    Document& document = _document.emplace(&_valuePool, FIRST_STACK_BYTES, &_stackPool);
    rapidjson::GenericReader<rapidjson::UTF8<>, rapidjson::UTF8<>, PoolAllocator> reader(
        &_stackPool,
        FIRST_STACK_BYTES);
    TextStream stream = MakeStream(body, _valuePool);
    rapidjson::ParseResult outcome;
    StrictHandler handler(document, limits, body.find('\\') != std::string_view::npos);
    const auto generate = [&](Document& /*target*/) {
        outcome = bLenient ? reader.Parse<LENIENT_FLAGS>(stream, handler) : reader.Parse<PARSE_FLAGS>(stream, handler);
        return !outcome.IsError();
    };
    document.Populate(generate);
    if (handler.HasFoundHalfSurrogate())
    {
        return Core::Fail(Core::ECoreError::InvalidJSON, {}, "JSON", "half a surrogate pair");
    }
    if (handler.HasFoundLargeNumber())
    {
        return Core::Fail(Core::ECoreError::InvalidJSON, {}, "JSON", "a number beyond the range of a double");
    }
    if (handler.HasTooManyValues())
    {
        return FailTooManyValues(limits);
    }
    if (outcome.Code() == rapidjson::kParseErrorTermination)
    {
        return Core::Fail(Core::ECoreError::TooLarge, {}, fmt::format("at most {} levels of nesting", limits.depth));
    }
    if (outcome.IsError())
    {
        return Core::Fail(
            Core::ECoreError::InvalidJSON,
            {},
            "JSON",
            fmt::format(
                "{}: {}",
                DescribePosition(body, outcome.Offset()),
                rapidjson::GetParseError_En(outcome.Code())));
    }
    // A NUL byte ends RapidJSON's stream as the real end does: what follows it would pass unseen.
    if (stream.Tell() != body.size())
    {
        return Core::Fail(
            Core::ECoreError::InvalidJSON,
            {},
            "JSON",
            fmt::format("a NUL at {}", DescribePosition(body, stream.Tell())));
    }
    return &document;
}

const Value* FindFirstOrNull(const Value& object, std::string_view name)
{
    if (!object.IsObject())
    {
        return nullptr;
    }
    const auto length = static_cast<rapidjson::SizeType>(name.size());
    const auto found = object.FindMember(Value(rapidjson::StringRef(name.data(), length)));
    return found == object.MemberEnd() || found->value.IsNull() ? nullptr : &found->value;
}

std::string WriteText(const Value& value)
{
    rapidjson::StringBuffer buffer;
    rapidjson::Writer<rapidjson::StringBuffer> writer(buffer);
    value.Accept(writer);
    return {buffer.GetString(), buffer.GetSize()};
}

std::string ShortenForError(const Value& value)
{
    if (value.IsObject())
    {
        return "an object";
    }
    if (value.IsArray())
    {
        return "an array";
    }
    std::string text = WriteText(value);
    if (text.size() > LONGEST_FOUND)
    {
        std::size_t end = LONGEST_FOUND;
        while (end > 0 && IsUtf8Continuation(text[end]))
        {
            --end;
        }
        text.resize(end);
        text += "...";
    }
    return text;
}

bool HasDuplicateNames(const Value& value)
{
    std::vector<const Value*> pending{&value};
    while (!pending.empty())
    {
        const Value& current = *pending.back();
        pending.pop_back();
        if (current.IsArray())
        {
            for (const Value& element : current.GetArray())
            {
                pending.push_back(&element);
            }
        }
        else if (current.IsObject())
        {
            if (HasDuplicateNamesHere(current))
            {
                return true;
            }
            for (const auto& member : current.GetObject())
            {
                pending.push_back(&member.value);
            }
        }
    }
    return false;
}

} // namespace ACS::Json
