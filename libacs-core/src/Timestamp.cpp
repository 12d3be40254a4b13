#include <acs/core/Timestamp.hpp>

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace ACS::Core
{

namespace
{

using std::chrono::minutes;

constexpr int MIN_YEAR = 1678;
constexpr int MAX_YEAR = 2261;
constexpr int MAX_HOUR = 23;
constexpr int MAX_MINUTE = 59;
constexpr int MAX_SECOND = 59;
constexpr std::size_t MAX_FRACTION_DIGITS = 9;
constexpr std::size_t UTC_LENGTH = 24;

bool IsDigit(char character)
{
    return character >= '0' && character <= '9';
}

/// Parses a text from the left; every step returns whether the text is valid so far.
class Scanner
{
    std::string_view _rest;

public:
    explicit Scanner(std::string_view text)
        : _rest(text)
    {
    }

    [[nodiscard]] bool IsAtEnd() const
    {
        return _rest.empty();
    }

    [[nodiscard]] bool TryCharacter(char upper)
    {
        const char lower = upper >= 'A' && upper <= 'Z' ? static_cast<char>(upper - 'A' + 'a') : upper;
        if (_rest.empty() || (_rest.front() != upper && _rest.front() != lower))
        {
            return false;
        }
        _rest.remove_prefix(1);
        return true;
    }

    /// Exactly this many digits, and a value from minimum to maximum.
    [[nodiscard]] bool TryNumber(std::size_t digits, int minimum, int maximum, int& value)
    {
        if (_rest.size() < digits)
        {
            return false;
        }
        value = 0;
        for (const char character : _rest.substr(0, digits))
        {
            if (!IsDigit(character))
            {
                return false;
            }
            value = value * 10 + (character - '0');
        }
        _rest.remove_prefix(digits);
        return value >= minimum && value <= maximum;
    }

    /// 1 to 9 digits behind the point.
    [[nodiscard]] bool TryFraction(std::chrono::nanoseconds& value)
    {
        std::int64_t count = 0;
        std::size_t digits = 0;
        while (!_rest.empty() && IsDigit(_rest.front()) && digits < MAX_FRACTION_DIGITS)
        {
            count = count * 10 + (_rest.front() - '0');
            _rest.remove_prefix(1);
            ++digits;
        }
        for (std::size_t i = digits; i < MAX_FRACTION_DIGITS; ++i)
        {
            count *= 10;
        }
        value = std::chrono::nanoseconds(count);
        return digits > 0;
    }
};

std::optional<std::chrono::sys_days> ReadDateOrNull(Scanner& scanner)
{
    int year = 0;
    int month = 0;
    int day = 0;
    const bool bShape = scanner.TryNumber(4, MIN_YEAR, MAX_YEAR, year) && scanner.TryCharacter('-')
        && scanner.TryNumber(2, 1, 12, month) && scanner.TryCharacter('-') && scanner.TryNumber(2, 1, 31, day);
    const std::chrono::year_month_day date{
        std::chrono::year(year),
        std::chrono::month(static_cast<unsigned>(month)),
        std::chrono::day(static_cast<unsigned>(day))};
    if (!bShape || !date.ok())
    {
        return std::nullopt;
    }
    return static_cast<std::chrono::sys_days>(date);
}

std::optional<std::chrono::nanoseconds> ReadTimeOfDayOrNull(Scanner& scanner)
{
    int hour = 0;
    int minute = 0;
    int second = 0;
    std::chrono::nanoseconds fraction{0};
    const bool bShape = scanner.TryNumber(2, 0, MAX_HOUR, hour) && scanner.TryCharacter(':')
        && scanner.TryNumber(2, 0, MAX_MINUTE, minute) && scanner.TryCharacter(':')
        && scanner.TryNumber(2, 0, MAX_SECOND, second);
    if (!bShape || (scanner.TryCharacter('.') && !scanner.TryFraction(fraction)))
    {
        return std::nullopt;
    }
    return std::chrono::hours(hour) + minutes(minute) + std::chrono::seconds(second) + fraction;
}

std::optional<minutes> ReadOffsetOrNull(Scanner& scanner, minutes defaultOffset)
{
    if (scanner.IsAtEnd())
    {
        return defaultOffset;
    }
    if (scanner.TryCharacter('Z'))
    {
        return minutes(0);
    }
    const bool bAhead = scanner.TryCharacter('+');
    int hour = 0;
    int minute = 0;
    if ((!bAhead && !scanner.TryCharacter('-')) || !scanner.TryNumber(2, 0, MAX_HOUR, hour))
    {
        return std::nullopt;
    }
    // The colon is optional, so that it is not there is no error.
    static_cast<void>(scanner.TryCharacter(':'));
    if (!scanner.TryNumber(2, 0, MAX_MINUTE, minute))
    {
        return std::nullopt;
    }
    const minutes offset = std::chrono::hours(hour) + minutes(minute);
    return bAhead ? offset : -offset;
}

/// Fills a text of a fixed length from the left.
template <std::size_t LENGTH>
class Printer
{
    std::array<char, LENGTH> _text{};
    std::size_t _position = 0;

public:
    void Put(char character)
    {
        _text[_position] = character;
        ++_position;
    }

    void PutNumber(std::size_t digits, std::int64_t value)
    {
        for (std::size_t i = digits; i > 0; --i)
        {
            _text[_position + i - 1] = static_cast<char>('0' + value % 10);
            value /= 10;
        }
        _position += digits;
    }

    /// 2025-07-02T12:00:00.123
    void PutDateAndTime(WallTime time)
    {
        const auto inMilliseconds = std::chrono::floor<std::chrono::milliseconds>(time);
        const auto days = std::chrono::floor<std::chrono::days>(inMilliseconds);
        const std::chrono::year_month_day date(days);
        const std::chrono::hh_mm_ss timeOfDay(inMilliseconds - days);
        PutNumber(4, static_cast<int>(date.year()));
        Put('-');
        PutNumber(2, static_cast<unsigned>(date.month()));
        Put('-');
        PutNumber(2, static_cast<unsigned>(date.day()));
        Put('T');
        PutNumber(2, timeOfDay.hours().count());
        Put(':');
        PutNumber(2, timeOfDay.minutes().count());
        Put(':');
        PutNumber(2, timeOfDay.seconds().count());
        Put('.');
        PutNumber(3, timeOfDay.subseconds().count());
    }

    [[nodiscard]] const std::array<char, LENGTH>& GetText() const
    {
        assert(_position == LENGTH);
        return _text;
    }
};

} // namespace

Result<Timestamp> ParseTimestamp(std::string_view text, std::chrono::minutes defaultOffset)
{
    Scanner scanner(text);
    const std::optional<std::chrono::sys_days> dateOrNull = ReadDateOrNull(scanner);
    if (dateOrNull.has_value() && scanner.TryCharacter('T'))
    {
        const std::optional<std::chrono::nanoseconds> timeOfDayOrNull = ReadTimeOfDayOrNull(scanner);
        const std::optional<minutes> offsetOrNull = ReadOffsetOrNull(scanner, defaultOffset);
        if (timeOfDayOrNull.has_value() && offsetOrNull.has_value() && scanner.IsAtEnd())
        {
            const WallTime local = std::chrono::time_point_cast<WallTime::duration>(*dateOrNull + *timeOfDayOrNull);
            return Timestamp{local - *offsetOrNull, *offsetOrNull};
        }
    }
    return Fail(ECoreError::InvalidTimestamp, {}, "an ISO 8601 date and time", QuoteForError(text));
}

LocalTimeText PrintLocal(WallTime time, std::chrono::minutes offset)
{
    assert(std::chrono::abs(offset) < std::chrono::days(1));
    const auto distance = std::chrono::abs(offset) % std::chrono::days(1);
    Printer<LOCAL_TIME_LENGTH> printer;
    printer.PutDateAndTime(time + offset);
    printer.Put(offset < minutes(0) ? '-' : '+');
    printer.PutNumber(2, distance / std::chrono::hours(1));
    printer.Put(':');
    printer.PutNumber(2, distance % std::chrono::hours(1) / minutes(1));
    return printer.GetText();
}

std::string FormatLocal(WallTime time, std::chrono::minutes offset)
{
    const LocalTimeText text = PrintLocal(time, offset);
    return {text.data(), text.size()};
}

std::string FormatUTC(WallTime time)
{
    Printer<UTC_LENGTH> printer;
    printer.PutDateAndTime(time);
    printer.Put('Z');
    return {printer.GetText().data(), UTC_LENGTH};
}

} // namespace ACS::Core
