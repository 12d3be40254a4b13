#include <acs/json/JsonWriter.hpp>

#include <fmt/compile.h>

#include <array>
#include <cassert>
#include <charconv>
#include <cmath>
#include <cstdint>

namespace ACS::Json
{

namespace
{

constexpr std::size_t LONGEST_NUMBER = 32;

/// Whole numbers and thousandths, which is most of what robots send, without the search for the shortest text: where k
/// thousandths are this number, no shorter text is. False for all others.
bool TryAppendThousandths(std::string& out, double value)
{
    constexpr double SCALE = 1000.0;
    constexpr double LIMIT = 1e12;
    const double magnitude = std::abs(value);
    if (!(magnitude < LIMIT))
    {
        return false;
    }
    const auto thousandths = static_cast<std::uint64_t>(std::llround(magnitude * SCALE));
    if (static_cast<double>(thousandths) / SCALE != magnitude)
    {
        return false;
    }
    std::array<char, LONGEST_NUMBER> digits{};
    char* end = digits.data();
    *end = '-';
    end += value < 0 ? 1 : 0;
    end = std::to_chars(end, digits.data() + digits.size(), thousandths / 1000).ptr;
    std::uint64_t rest = thousandths % 1000;
    if (rest != 0)
    {
        *end++ = '.';
        for (std::uint64_t unit = 100; rest != 0; unit /= 10)
        {
            *end++ = static_cast<char>('0' + rest / unit);
            rest %= unit;
        }
    }
    out.append(digits.data(), end);
    return true;
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
    Core::JsonText::AppendString(value, _out);
}

void JsonWriter::WriteString(std::string_view front, std::string_view back)
{
    WriteString(front);
    _out.pop_back();
    const std::size_t joint = _out.size();
    Core::JsonText::AppendString(back, _out);
    _out.erase(joint, 1);
}

void JsonWriter::WritePlainString(std::string_view value)
{
    _out += NeedsComma() ? std::string_view(",\"") : std::string_view("\"");
    _out += value;
    _out += '"';
}

void JsonWriter::WriteNumber(double value)
{
    if (!std::isfinite(value))
    {
        WriteNull(); // A reader that needs the number rejects this; it would believe a 0.
        return;
    }
    Separate();
    if (!TryAppendThousandths(_out, value))
    {
        std::array<char, LONGEST_NUMBER> digits{};
        _out.append(digits.data(), fmt::format_to(digits.data(), FMT_COMPILE("{}"), value));
    }
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
    // A line end at its end would look like the beginning of a text to what follows.
    const std::string_view text = value.GetText();
    _out += text.substr(0, text.find_last_not_of(" \t\r\n") + 1);
}

} // namespace ACS::Json
