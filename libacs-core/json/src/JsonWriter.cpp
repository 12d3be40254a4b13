#include <acs/json/JsonWriter.hpp>

#include <array>
#include <cassert>
#include <charconv>
#include <cmath>

namespace ACS::Json
{

namespace
{

constexpr std::string_view REPLACEMENT = "\xEF\xBF\xBD";
constexpr std::string_view HEX = "0123456789abcdef";
constexpr std::size_t LONGEST_NUMBER = 32;

/// For each byte: 0 = stands for itself, 'u' = \u00XX, '8' = start of a UTF-8 sequence, else the letter behind '\'.
constexpr std::array<char, 256> MakeEscapes()
{
    std::array<char, 256> table{};
    for (std::size_t byte = 0; byte < 0x20; ++byte)
    {
        table[byte] = 'u';
    }
    for (std::size_t byte = 0x80; byte < table.size(); ++byte)
    {
        table[byte] = '8';
    }
    table['\b'] = 'b';
    table['\f'] = 'f';
    table['\n'] = 'n';
    table['\r'] = 'r';
    table['\t'] = 't';
    table['"'] = '"';
    table['\\'] = '\\';
    return table;
}

constexpr std::array<char, 256> ESCAPES = MakeEscapes();

bool IsInside(unsigned char byte, unsigned char lowest, unsigned char highest)
{
    return byte >= lowest && byte <= highest;
}

/// Length of the well-formed UTF-8 sequence at the front (Unicode 15, table 3-7), 0 where there is none.
std::size_t GetSequenceLength(std::string_view text)
{
    const auto byteAt = [text](std::size_t index) -> unsigned char {
        return index < text.size() ? static_cast<unsigned char>(text[index]) : 0;
    };
    const unsigned char first = byteAt(0);
    if (IsInside(first, 0xC2, 0xDF))
    {
        return IsInside(byteAt(1), 0x80, 0xBF) ? 2 : 0;
    }
    if (IsInside(first, 0xE0, 0xEF))
    {
        const unsigned char lowest = first == 0xE0 ? 0xA0 : 0x80;
        const unsigned char highest = first == 0xED ? 0x9F : 0xBF;
        return IsInside(byteAt(1), lowest, highest) && IsInside(byteAt(2), 0x80, 0xBF) ? 3 : 0;
    }
    if (IsInside(first, 0xF0, 0xF4))
    {
        const unsigned char lowest = first == 0xF0 ? 0x90 : 0x80;
        const unsigned char highest = first == 0xF4 ? 0x8F : 0xBF;
        const bool bTail = IsInside(byteAt(2), 0x80, 0xBF) && IsInside(byteAt(3), 0x80, 0xBF);
        return IsInside(byteAt(1), lowest, highest) && bTail ? 4 : 0;
    }
    return 0;
}

template <typename TNumber>
void AppendNumber(std::string& out, TNumber value)
{
    std::array<char, LONGEST_NUMBER> digits{};
    const auto [end, error] = std::to_chars(digits.data(), digits.data() + digits.size(), value);
    assert(error == std::errc());
    static_cast<void>(error);
    out.append(digits.data(), end);
}

} // namespace

JsonWriter::JsonWriter(std::string& out, DialectFlags dialect)
    : _out(out),
      _dialect(dialect)
{
}

void JsonWriter::Separate()
{
    if (_out.empty())
    {
        return;
    }
    const char last = _out.back();
    if (last != '{' && last != '[' && last != ':' && last != ',' && last != '\n')
    {
        _out += ',';
    }
}

void JsonWriter::BeginObject()
{
    Separate();
    _out += '{';
}

void JsonWriter::EndObject()
{
    _out += '}';
}

void JsonWriter::BeginArray()
{
    Separate();
    _out += '[';
}

void JsonWriter::EndArray()
{
    _out += ']';
}

void JsonWriter::Key(std::string_view name)
{
    WriteString(name);
    _out += ':';
}

void JsonWriter::WriteString(std::string_view value)
{
    Separate();
    _out += '"';
    std::size_t begin = 0;
    for (std::size_t position = 0; position < value.size();)
    {
        const auto byte = static_cast<unsigned char>(value[position]);
        const char escape = ESCAPES[byte];
        if (escape == 0)
        {
            ++position;
            continue;
        }
        const std::size_t sequence = escape == '8' ? GetSequenceLength(value.substr(position)) : 0;
        if (sequence != 0)
        {
            position += sequence;
            continue;
        }
        _out.append(value, begin, position - begin);
        if (escape == '8')
        {
            _out += REPLACEMENT;
        }
        else if (escape == 'u')
        {
            _out += "\\u00";
            _out += HEX[byte >> 4U];
            _out += HEX[byte & 0xFU];
        }
        else
        {
            _out += '\\';
            _out += escape;
        }
        ++position;
        begin = position;
    }
    _out.append(value, begin, value.size() - begin);
    _out += '"';
}

void JsonWriter::WriteNumber(double value)
{
    assert(std::isfinite(value));
    Separate();
    AppendNumber(_out, std::isfinite(value) ? value : 0.0);
}

void JsonWriter::WriteInteger(std::int64_t value)
{
    Separate();
    AppendNumber(_out, value);
}

void JsonWriter::WriteUnsigned(std::uint64_t value)
{
    Separate();
    AppendNumber(_out, value);
}

void JsonWriter::WriteBoolean(bool bValue)
{
    Separate();
    _out += bValue ? "true" : "false";
}

void JsonWriter::WriteNull()
{
    Separate();
    _out += "null";
}

void JsonWriter::WriteRaw(const Core::JsonText& value)
{
    Separate();
    _out += value.GetText();
}

} // namespace ACS::Json
