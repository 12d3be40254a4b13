#include "common/trace/TraceOptions.hpp"

#include "common/config/CommandLine.hpp"
#include <acs/core/ParseNumber.hpp>
#include <acs/core/Result.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <cstdint>

namespace ACS::Apps
{

namespace
{

template <typename TNumber>
std::string ReadLimit(const std::string& text, std::int64_t smallest, std::int64_t largest, TNumber& target)
{
    const std::optional<std::int64_t> number = Core::ParseNumberOrNull<std::int64_t>(text);
    if (!number.has_value() || *number < smallest || *number > largest)
    {
        return fmt::format("expected a number from {} to {}, found {}", smallest, largest, Core::QuoteForError(text));
    }
    target = static_cast<TNumber>(*number);
    return {};
}

} // namespace

void AddTraceOptions(CLI::App& app, TraceOptions& options)
{
    CLI::Option& folder = AddTextOption(
        app,
        "--trace",
        [&options](const std::string& text) {
            options.folder = text;
            return std::string(text.empty() ? "expected a folder; it is created if necessary" : "");
        },
        "Write every message that is received or sent to files in this folder, a line of JSON each "
        "(docs/reference/trace.md; default: no trace)");
    folder.type_name("DIR");
    CLI::Option& fileBytes = AddTextOption(
        app,
        "--trace-max-file-bytes",
        [&options](const std::string& text) {
            return ReadLimit(text, TraceLimits::SMALLEST_FILE, TraceLimits::LARGEST_FILE, options.limits.maxFileBytes);
        },
        "Maximum size of a file of --trace");
    fileBytes.default_str(fmt::to_string(options.limits.maxFileBytes))->type_name("BYTES")->needs(&folder);
    CLI::Option& files = AddTextOption(
        app,
        "--trace-max-files",
        [&options](const std::string& text) {
            return ReadLimit(text, 1, TraceLimits::MOST_FILES, options.limits.maxFiles);
        },
        "Number of files of --trace that are kept; the oldest are deleted");
    files.default_str(fmt::to_string(options.limits.maxFiles))->type_name("N")->needs(&folder);
}

} // namespace ACS::Apps
