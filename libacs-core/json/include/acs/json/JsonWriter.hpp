#pragma once

#include <acs/core/JsonText.hpp>
#include <acs/json/JsonFields.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace ACS::Json
{

/// Appends compact JSON to a string of the caller, who reuses it: writing allocates nothing once it has grown. Members
/// come out in the order in which they are written. What is not UTF-8 in a string is written as U+FFFD.
class JsonWriter
{
    std::string& _out;
    DialectFlags _dialect;

public:
    /// Of the fields that are bound to dialects, those of this one are written.
    explicit JsonWriter(std::string& out, DialectFlags dialect = ALL_DIALECTS);

    [[nodiscard]] DialectFlags GetDialect() const noexcept
    {
        return _dialect;
    }

    void BeginObject();
    void EndObject();
    void BeginArray();
    void EndArray();
    void Key(std::string_view name);

    /// A key that was made in advance (KeyText): `,"name":` with the comma that a first member leaves out.
    void WriteKeyText(std::string_view text)
    {
        text.remove_prefix(NeedsComma() ? 0 : 1);
        _out += text;
    }

    void WriteString(std::string_view value);
    /// A string in two parts.
    void WriteString(std::string_view front, std::string_view back);
    /// A string of printable ASCII without quotes and backslashes: the words of an enumeration, a time.
    void WritePlainString(std::string_view value);
    /// Null if the value is not finite: JSON has no other word for it.
    void WriteNumber(double value);
    void WriteInteger(std::int64_t value);
    void WriteUnsigned(std::uint64_t value);
    void WriteBoolean(bool bValue);
    void WriteNull();
    void WriteRaw(const Core::JsonText& value);

private:
    /// Whether the next value follows another member or element.
    [[nodiscard]] bool NeedsComma() const noexcept
    {
        const char last = _out.empty() ? '\n' : _out.back();
        return last != '{' && last != '[' && last != ':' && last != ',' && last != '\n';
    }

    void Separate()
    {
        if (NeedsComma())
        {
            _out += ',';
        }
    }
};

} // namespace ACS::Json
