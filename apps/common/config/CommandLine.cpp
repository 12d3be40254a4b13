#include "common/config/CommandLine.hpp"

#include "common/config/DurationText.hpp"
#include "common/log/LogText.hpp"
#include "common/Version.hpp"
#include <acs/core/ControlCharacter.hpp>
#include <acs/core/Result.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <utility>

namespace ACS::Apps
{

namespace
{

constexpr double MIN_TIME_SCALE = 0.01;
constexpr double MAX_TIME_SCALE = 1000.0;

} // namespace

void AddCommonOptions(CLI::App& app, CommonOptions& options)
{
    app.set_version_flag("--version", fmt::format("{} {}", app.get_name(), VERSION));
    AddTextOption(
        app,
        "--log-level",
        [&options](const std::string& text) { return AssignValue(ParseLogLevel(text), options.logLevel); },
        "What to log on standard error: debug, info, warning or error")
        .default_str("info");
}

CLI::Option& AddEndpointOption(CLI::App& app, const std::string& name, Endpoint& target, const std::string& help)
{
    CLI::Option& option = AddTextOption(
        app,
        name,
        [&target](const std::string& text) { return AssignValue(ParseEndpoint(text), target); },
        help);
    option.type_name("HOST:PORT");
    if (!target.host.empty())
    {
        option.default_str(MakeText(target));
    }
    return option;
}

CLI::Option& AddUrlOption(
    CLI::App& app,
    const std::string& name,
    Url& target,
    const std::vector<EUrlScheme>& allowed,
    const std::string& help)
{
    CLI::Option& option = AddTextOption(
        app,
        name,
        [&target, allowed](const std::string& text) { return AssignValue(ParseURL(text, allowed), target); },
        help);
    option.type_name("URL");
    if (!target.peer.host.empty())
    {
        option.default_str(MakeText(target));
    }
    return option;
}

CLI::Option& AddDurationOption(
    CLI::App& app,
    const std::string& name,
    std::chrono::milliseconds& target,
    const std::string& help)
{
    CLI::Option& option = AddTextOption(
        app,
        name,
        [&target](const std::string& text) {
            const Core::Result<std::chrono::milliseconds> duration = ParseDuration(text);
            return duration == std::chrono::milliseconds(0) ? std::string("expected a duration above 0")
                                                            : AssignValue(duration, target);
        },
        help);
    option.type_name("DURATION");
    return option;
}

CLI::Option& AddTimeScaleOption(CLI::App& app, double& target)
{
    CLI::Option* const option = app.add_option("--time-scale", target, "Speed relative to real time, 0.01 to 1000");
    // CLI::Range alone accepts text that is not a number.
    option->check([](const std::string& text) {
        double scale = 0.0;
        const bool bNumber =
            CLI::detail::lexical_cast(text, scale) && scale >= MIN_TIME_SCALE && scale <= MAX_TIME_SCALE;
        return bNumber ? std::string()
                       : fmt::format(
                           "expected a number from {} to {}, found {}",
                           MIN_TIME_SCALE,
                           MAX_TIME_SCALE,
                           Core::QuoteForError(text));
    });
    return *option->capture_default_str();
}

CLI::Option& AddCountOption(
    CLI::App& app,
    const std::string& name,
    std::size_t& target,
    const NumberRange<std::size_t>& range,
    const std::string& help)
{
    CLI::Option& option = AddTextOption(
        app,
        name,
        [&target, range](const std::string& text) { return AssignNumber(text, range, target); },
        help);
    return *option.type_name("N");
}

CLI::Option& AddTextOption(CLI::App& app, const std::string& name, TextReader reader, const std::string& help)
{
    CLI::Option& option = AddRepeatedOption(app, name, std::move(reader), help);
    return *option.multi_option_policy(CLI::MultiOptionPolicy::Throw);
}

CLI::Option& AddFileOption(CLI::App& app, const std::string& name, std::string& target, const std::string& help)
{
    CLI::Option& option = AddTextOption(
        app,
        name,
        [&target](const std::string& text) {
            target = text;
            return std::string(text.empty() ? "expected a file" : "");
        },
        help);
    option.type_name("FILE");
    return option;
}

CLI::Option& AddRepeatedOption(CLI::App& app, const std::string& name, TextReader reader, const std::string& help)
{
    CLI::Option* const option = app.add_option_function<std::vector<std::string>>(
        name,
        [name, reader = std::move(reader)](const std::vector<std::string>& values) {
            for (const std::string& value : values)
            {
                const std::string error = reader(value);
                if (!error.empty())
                {
                    throw CLI::ValidationError(name, error);
                }
            }
        },
        help);
    return *option->type_name("TEXT")->expected(1)->allow_extra_args(false)->multi_option_policy(
        CLI::MultiOptionPolicy::TakeAll);
}

namespace
{

/// An unknown word explains more than what is missing because of it.
std::string Explain(const CLI::App& app, const CLI::ParseError& error)
{
    const std::vector<std::string> unknown = app.remaining(true);
    const bool bMissing = dynamic_cast<const CLI::RequiredError*>(&error) != nullptr;
    return bMissing && !unknown.empty() ? CLI::ExtrasError(unknown).what() : error.what();
}

int PrintOutput(const CLI::App& app, const std::string& text, int outputFailure)
{
    if (std::cout << text << std::flush)
    {
        return EXIT_SUCCESS;
    }
    PrintError(app.get_name(), "the output could not be written");
    return outputFailure;
}

} // namespace

std::optional<int> ParseCommandLineOrNull(CLI::App& app, int argc, const char* const* argv)
{
    return ParseCommandLineOrNull(app, argc, argv, EXIT_FAILURE);
}

std::optional<int> ParseCommandLineOrNull(CLI::App& app, int argc, const char* const* argv, int outputFailure)
{
    try
    {
        app.parse(argc, argv);
        return std::nullopt;
    }
    catch (const CLI::CallForHelp&)
    {
        return PrintOutput(app, app.help(), outputFailure);
    }
    catch (const CLI::CallForVersion&)
    {
        return PrintOutput(app, fmt::format("{} {}\n", app.get_name(), VERSION), outputFailure);
    }
    catch (const CLI::ParseError& error)
    {
        PrintError(app.get_name(), fmt::format("{}; try {} --help", Explain(app, error), app.get_name()));
        return EXIT_BAD_COMMAND_LINE;
    }
}

void PrintError(std::string_view program, std::string_view text)
{
    std::string line(text);
    std::ranges::replace(line, '\n', ' ');
    std::cerr << fmt::format("{}: {}", program, MakePrintable(line)) << std::endl;
}

int RunProgram(std::string_view program, const std::function<int()>& body)
{
    try
    {
        return body();
    }
    catch (const std::exception& error)
    {
        PrintError(program, fmt::format("stopped by an unexpected error: {}", error.what()));
        return EXIT_FAILURE;
    }
}

} // namespace ACS::Apps
