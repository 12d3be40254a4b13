#pragma once

#include <acs/core/Logger.hpp>

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Testing
{

/// A log line with copies of everything that was in it.
struct RecordedLine
{
    Core::ELogLevel level = Core::ELogLevel::Debug;
    std::string component;
    std::string message;
    std::vector<std::pair<std::string, std::string>> fields;

    [[nodiscard]] bool HasField(std::string_view key, std::string_view value) const
    {
        return std::ranges::any_of(fields, [key, value](const auto& field) {
            return field.first == key && field.second == value;
        });
    }
};

/// Keeps every line, of all levels.
class RecordingLogSink final : public Core::ILogSink
{
    std::vector<RecordedLine> _lines;

public:
    [[nodiscard]] bool ShouldWrite(Core::ELogLevel /*level*/) const override
    {
        return true;
    }

    void Write(
        Core::ELogLevel level,
        std::string_view component,
        std::string_view message,
        std::initializer_list<Core::LogField> fields) override
    {
        RecordedLine line{level, std::string(component), std::string(message), {}};
        for (const Core::LogField& field : fields)
        {
            line.fields.emplace_back(field.key, field.value);
        }
        _lines.push_back(std::move(line));
    }

    [[nodiscard]] const std::vector<RecordedLine>& GetLines() const noexcept
    {
        return _lines;
    }

    /// Whether a line of this level has the text in its message.
    [[nodiscard]] bool Contains(Core::ELogLevel level, std::string_view part) const
    {
        return std::ranges::any_of(_lines, [level, part](const RecordedLine& line) {
            return line.level == level && line.message.find(part) != std::string::npos;
        });
    }

    /// Whether any line has this field.
    [[nodiscard]] bool ContainsField(std::string_view key, std::string_view value) const
    {
        return std::ranges::any_of(_lines, [key, value](const RecordedLine& line) {
            return line.HasField(key, value);
        });
    }

    [[nodiscard]] std::size_t CountLevel(Core::ELogLevel level) const
    {
        return static_cast<std::size_t>(std::ranges::count(_lines, level, &RecordedLine::level));
    }

    void Clear()
    {
        _lines.clear();
    }
};

} // namespace ACS::Testing
