#include "common/faults/FaultText.hpp"

#include "common/config/DurationText.hpp"
#include "common/config/WordReader.hpp"
#include <acs/core/JsonText.hpp>
#include <acs/core/ParseNumber.hpp>

#include <fmt/format.h>

#include <cmath>

namespace ACS::Apps
{

namespace
{

constexpr std::size_t MAX_LINE_LENGTH = 1000; ///< Log lines and messages repeat the text.
constexpr std::size_t MAX_COMMANDS = 1000;
constexpr std::string_view BYTE_ORDER_MARK = "\xEF\xBB\xBF";
constexpr char EVERY = '*';
constexpr char REMARK = '#';

} // namespace

std::string ReadDurationValue(std::string_view text, Core::Duration& target)
{
    const Core::Result<std::chrono::milliseconds> duration = ParseDuration(text);
    if (!duration.has_value())
    {
        return duration.error().expected;
    }
    target = *duration;
    return {};
}

std::string ReadNumberValue(std::string_view text, double max, double& target)
{
    const std::optional<double> number = Core::ParseNumberOrNull<double>(text);
    if (!number.has_value() || !std::isfinite(*number) || *number < 0.0 || *number > max)
    {
        return fmt::format("a number from 0 to {}", max);
    }
    target = *number;
    return {};
}

std::string ReadCountValue(std::string_view text, std::uint32_t max, std::uint32_t& target)
{
    const std::optional<std::uint32_t> count = Core::ParseNumberOrNull<std::uint32_t>(text);
    if (!count.has_value() || *count < 1 || *count > max)
    {
        return fmt::format("a number from 1 to {}", max);
    }
    target = *count;
    return {};
}

std::string ReadNameValue(std::string_view text, std::string& target)
{
    target = std::string(text);
    return text.empty() ? "a name" : "";
}

Core::Result<void> CheckCommandLine(std::string_view line)
{
    if (line.size() > MAX_LINE_LENGTH)
    {
        return Core::Fail(
            Core::ECoreError::TooLarge,
            {},
            fmt::format("at most {} bytes", MAX_LINE_LENGTH),
            fmt::format("{} bytes", line.size()));
    }
    if (!Core::JsonText::IsUtf8(line))
    {
        return Core::Fail(Core::ECoreError::InvalidIdentifier, {}, "text in UTF-8", Core::QuoteForError(line));
    }
    return {};
}

Core::Result<void> ReadCommandLines(
    std::string_view text,
    const std::function<Core::Result<void>(std::string_view line)>& reader)
{
    if (text.starts_with(BYTE_ORDER_MARK))
    {
        text.remove_prefix(BYTE_ORDER_MARK.size());
    }
    std::size_t commands = 0;
    for (std::size_t number = 1; !text.empty(); ++number)
    {
        const std::size_t end = text.find('\n');
        const std::string_view whole = text.substr(0, end);
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
        const std::string_view line = whole.substr(0, whole.find(REMARK));
        std::string_view probe = line;
        if (TakeWord(probe).empty())
        {
            continue;
        }
        if (++commands > MAX_COMMANDS)
        {
            return Core::Fail(
                Core::ECoreError::TooLarge,
                fmt::format("line {}", number),
                fmt::format("at most {} commands", MAX_COMMANDS));
        }
        Core::Result<void> read = reader(line);
        if (!read.has_value())
        {
            Core::Error error = std::move(read.error());
            error.path =
                error.path.empty() ? fmt::format("line {}", number) : fmt::format("line {}, {}", number, error.path);
            return tl::make_unexpected(std::move(error));
        }
    }
    return {};
}

bool IsTarget(std::string_view targets, std::string_view name)
{
    return targets.ends_with(EVERY) ? name.starts_with(targets.substr(0, targets.size() - 1)) : name == targets;
}

} // namespace ACS::Apps
