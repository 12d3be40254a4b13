#include <acs/core/ControlCharacter.hpp>
#include <acs/json/JsonDecoder.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace ACS::Json
{

namespace
{

constexpr double EXACT_INTEGER_LIMIT = 9007199254740992.0; // 2^53: beyond it a double skips integers

std::string DescribeRange(const FieldBounds& bounds)
{
    if (std::isinf(bounds.minimum) && std::isinf(bounds.maximum))
    {
        return "a finite number";
    }
    if (std::isinf(bounds.maximum))
    {
        return fmt::format("a number of at least {}", bounds.minimum);
    }
    if (std::isinf(bounds.minimum))
    {
        return fmt::format("a number of at most {}", bounds.maximum);
    }
    return fmt::format("a number from {} to {}", bounds.minimum, bounds.maximum);
}

/// A number, or where the options allow it the number that a string spells.
bool TryReadDouble(const Value& value, double& out, DecodeContext& context)
{
    if (value.IsNumber())
    {
        out = value.GetDouble();
        return true;
    }
    if (!value.IsString() || !context.GetOptions().bNumericStringsAccepted)
    {
        return false;
    }
    const char* begin = value.GetString();
    const char* end = begin + value.GetStringLength();
    const auto [stop, error] = std::from_chars(begin, end, out);
    if (error != std::errc() || stop != end || !std::isfinite(out))
    {
        return false;
    }
    ++context.GetNotes().lenientNumbers;
    return true;
}

bool IsBadLength(std::size_t length, const FieldBounds& bounds, std::size_t fallbackMaximum)
{
    const bool bBounded = bounds.maximumLength != std::numeric_limits<std::size_t>::max();
    return length < bounds.minimumLength || length > (bBounded ? bounds.maximumLength : fallbackMaximum);
}

} // namespace

bool TryCheckRequired(
    std::uint64_t seen,
    std::uint64_t required,
    const std::string_view* namesOrNull,
    DecodeContext& context)
{
    if ((seen & required) == required)
    {
        return true;
    }
    std::size_t index = 0;
    while (((required & ~seen) >> index & 1U) == 0)
    {
        ++index;
    }
    static_cast<void>(context.IsFailedWith(
        make_error_code(Core::ECoreError::MissingField),
        "a value",
        "nothing (the member is missing)"));
    return context.IsFailedAt(namesOrNull[index]); // NOLINT(cppcoreguidelines-pro-bounds-pointer-arithmetic)
}

bool TryDecodeInteger(
    const Value& value,
    std::int64_t minimum,
    std::uint64_t maximum,
    std::int64_t& negativeOut,
    std::uint64_t& positiveOut,
    DecodeContext& context)
{
    const auto fail = [&]() {
        return context.IsFailedWith(
            value.IsNumber() ? Core::ECoreError::OutOfRange : Core::ECoreError::WrongType,
            fmt::format("an integer from {} to {}", minimum, maximum),
            &value);
    };
    if (value.IsUint64())
    {
        positiveOut = value.GetUint64();
    }
    else if (value.IsInt64())
    {
        negativeOut = value.GetInt64();
    }
    else
    {
        double number = 0.0;
        const bool bInteger = TryReadDouble(value, number, context) && std::floor(number) == number
            && std::abs(number) <= EXACT_INTEGER_LIMIT;
        if (!bInteger)
        {
            return fail();
        }
        negativeOut = number < 0 ? static_cast<std::int64_t>(number) : 0;
        positiveOut = number < 0 ? 0 : static_cast<std::uint64_t>(number);
    }
    const bool bInside = negativeOut < 0
        ? negativeOut >= minimum
        : positiveOut <= maximum && (minimum <= 0 || positiveOut >= static_cast<std::uint64_t>(minimum));
    return bInside || fail();
}

bool TryDecodeNumber(const Value& value, double& out, const FieldBounds& bounds, DecodeContext& context)
{
    if (!TryReadDouble(value, out, context))
    {
        return context.IsFailedWith(Core::ECoreError::WrongType, "a number", &value);
    }
    if (out < bounds.minimum || out > bounds.maximum)
    {
        return context.IsFailedWith(Core::ECoreError::OutOfRange, DescribeRange(bounds), &value);
    }
    return true;
}

bool TryDecodeString(const Value& value, std::string_view& out, const FieldBounds& bounds, DecodeContext& context)
{
    if (!value.IsString())
    {
        return context.IsFailedWith(Core::ECoreError::WrongType, "a string", &value);
    }
    out = std::string_view(value.GetString(), value.GetStringLength());
    if (IsBadLength(out.size(), bounds, context.GetOptions().maximumString))
    {
        return context.IsFailedWith(
            make_error_code(Core::ECoreError::OutOfRange),
            fmt::format(
                "a string of {} to {} bytes",
                bounds.minimumLength,
                std::min(bounds.maximumLength, context.GetOptions().maximumString)),
            fmt::format("{} bytes", out.size()));
    }
    if (bounds.bIdentifier && Core::HasControlCharacter(out))
    {
        return context.IsFailedWith(
            make_error_code(Core::ECoreError::InvalidIdentifier),
            "an identifier without control characters",
            Core::QuoteForError(out));
    }
    return true;
}

bool TryCheckArray(const Value& value, const FieldBounds& bounds, DecodeContext& context)
{
    if (!value.IsArray())
    {
        return context.IsFailedWith(Core::ECoreError::WrongType, "an array", &value);
    }
    if (IsBadLength(value.Size(), bounds, context.GetOptions().maximumArray))
    {
        return context.IsFailedWith(
            make_error_code(Core::ECoreError::OutOfRange),
            fmt::format(
                "an array of {} to {} elements",
                bounds.minimumLength,
                std::min(bounds.maximumLength, context.GetOptions().maximumArray)),
            fmt::format("{} elements", value.Size()));
    }
    return true;
}

bool ValueDecoder<bool>::TryDecode(
    const Value& value,
    bool& bOut,
    const FieldBounds& /*bounds*/,
    DecodeContext& context)
{
    if (!value.IsBool())
    {
        return context.IsFailedWith(Core::ECoreError::WrongType, "true or false", &value);
    }
    bOut = value.GetBool();
    return true;
}

bool ValueDecoder<std::string>::TryDecode(
    const Value& value,
    std::string& out,
    const FieldBounds& bounds,
    DecodeContext& context)
{
    std::string_view text;
    if (!TryDecodeString(value, text, bounds, context))
    {
        return false;
    }
    out.assign(text);
    return true;
}

bool ValueDecoder<Core::JsonText>::TryDecode(
    const Value& value,
    Core::JsonText& out,
    const FieldBounds& /*bounds*/,
    DecodeContext& context)
{
    if (value.IsString())
    {
        out = Core::JsonText::FromString({value.GetString(), value.GetStringLength()});
        return true;
    }
    if ((value.IsObject() || value.IsArray()) && HasDuplicateNames(value))
    {
        return context.IsFailedWith(
            make_error_code(Core::ECoreError::InvalidJSON),
            "each member once",
            "a member named twice");
    }
    out = Core::JsonText::FromTrusted(WriteText(value));
    return true;
}

bool ValueDecoder<DeferredValue>::TryDecode(
    const Value& value,
    DeferredValue& out,
    const FieldBounds& /*bounds*/,
    DecodeContext& /*context*/)
{
    out.valueOrNull = &value;
    return true;
}

} // namespace ACS::Json
