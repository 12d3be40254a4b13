#include <acs/json/JsonWriter.hpp>

#include <array>
#include <cassert>
#include <charconv>
#include <cmath>

namespace ACS::Json
{

namespace
{

constexpr std::size_t LONGEST_NUMBER = 32;

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
