#pragma once

#include "common/config/Endpoint.hpp"
#include "common/config/Url.hpp"
#include <acs/core/JsonText.hpp>
#include <acs/core/Logger.hpp>
#include <acs/core/ParseNumber.hpp>
#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <chrono>
#include <concepts>
#include <cstddef>
#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace CLI
{
class App;
class Option;
} // namespace CLI

namespace ACS::Apps
{

/// Exit codes that every program shares.
constexpr int EXIT_BAD_COMMAND_LINE = 2;

/// The options that every program has.
struct CommonOptions
{
    Core::ELogLevel logLevel = Core::ELogLevel::Info;
};

/// Adds --version (NAME VERSION) and --log-level (debug, info, warning, error); CLI11 adds --help itself.
/// The app must have the program's name: `CLI::App app{"what it does", "vda-sim"}`. The targets must outlive parsing.
void AddCommonOptions(CLI::App& app, CommonOptions& options);

/// An option whose value is HOST:PORT. The value of the target is shown as the default.
CLI::Option& AddEndpointOption(CLI::App& app, const std::string& name, Endpoint& target, const std::string& help);

/// An option whose value is a URL of one of these schemes.
CLI::Option& AddUrlOption(
    CLI::App& app,
    const std::string& name,
    Url& target,
    const std::vector<EUrlScheme>& allowed,
    const std::string& help);

/// An option whose value is a duration above 0, as ParseDuration reads it.
CLI::Option& AddDurationOption(
    CLI::App& app,
    const std::string& name,
    std::chrono::milliseconds& target,
    const std::string& help);

/// --time-scale X: speed of a simulator relative to real time, 0.01 to 1000 (default: the value of the target).
CLI::Option& AddTimeScaleOption(CLI::App& app, double& target);

/// Assigns a value and returns an empty text, or returns what was expected and found.
using TextReader = std::function<std::string(const std::string& value)>;

/// What a TextReader returns for a value that a function has parsed.
template <typename TValue>
[[nodiscard]] std::string AssignValue(Core::Result<TValue> parsed, TValue& target)
{
    if (!parsed.has_value())
    {
        return Core::Describe(parsed.error());
    }
    target = std::move(*parsed);
    return {};
}

/// The values that a number of the command line may have, both included.
template <std::integral TNumber>
struct NumberRange
{
    TNumber minimum = 0;
    TNumber maximum = std::numeric_limits<TNumber>::max();
};

/// What a TextReader returns for a whole number in decimal notation. CLI11 itself reads 010 as 8, and a large negative number
/// as a small positive one if the target has no sign.
template <std::integral TNumber, typename TTarget>
[[nodiscard]] std::string AssignNumber(const std::string& text, const NumberRange<TNumber>& range, TTarget& target)
{
    const std::optional<TNumber> number = Core::ParseNumberOrNull<TNumber>(text);
    if (!number.has_value() || *number < range.minimum || *number > range.maximum)
    {
        return fmt::format(
            "expected a number from {} to {}, found {}",
            range.minimum,
            range.maximum,
            Core::QuoteForError(text));
    }
    target = *number;
    return {};
}

/// An option whose value is a number of things. The value of the target is not shown as the default.
CLI::Option& AddCountOption(
    CLI::App& app,
    const std::string& name,
    std::size_t& target,
    const NumberRange<std::size_t>& range,
    const std::string& help);

/// An option that may be given once. The function reads its value.
CLI::Option& AddTextOption(CLI::App& app, const std::string& name, TextReader reader, const std::string& help);

/// An option whose value is the path of a file: not empty; its existence is not checked.
CLI::Option& AddFileOption(CLI::App& app, const std::string& name, std::string& target, const std::string& help);

/// An option that may be repeated, with one value each time; `.allow_extra_args()` on the result allows several values after
/// one name (--plan a.json b.json). The function is called for each value, in order.
CLI::Option& AddRepeatedOption(CLI::App& app, const std::string& name, TextReader reader, const std::string& help);

/// Reads the command line. Returns nullopt if the program is to continue, else its exit code: 0 after --help and --version
/// (on standard output), 1 if standard output cannot be written, 2 after an error (one line on standard error).
[[nodiscard]] std::optional<int> ParseCommandLineOrNull(CLI::App& app, int argc, const char* const* argv);

/// The same; the last parameter is the exit code if standard output cannot be written.
[[nodiscard]] std::optional<int> ParseCommandLineOrNull(
    CLI::App& app,
    int argc,
    const char* const* argv,
    int outputFailure);

/// One line on standard error, "NAME: text"; line ends within the text become spaces, other control characters are escaped.
void PrintError(std::string_view program, std::string_view text);

/// Runs the body of main(). An exception that nothing else caught becomes one line on standard error and exit code 1.
[[nodiscard]] int RunProgram(std::string_view program, const std::function<int()>& body);

} // namespace ACS::Apps
