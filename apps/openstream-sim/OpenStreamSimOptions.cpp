#include "OpenStreamSimOptions.hpp"

#include "common/DurationText.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>

namespace ACS::OpenStreamSim
{

namespace
{

constexpr std::string_view FAIL_SUFFIX = ",fail";

std::optional<int> ParseProgramNumberOrNull(std::string_view text)
{
    int number = 0;
    const char* const last = text.data() + text.size();
    const auto [end, error] = std::from_chars(text.data(), last, number);
    const bool bProgram = error == std::errc{} && end == last && number >= FIRST_PROGRAM && number <= LAST_PROGRAM;
    return bProgram ? std::optional(number) : std::nullopt;
}

std::string MakeFooter()
{
    return fmt::format(
        "A program takes its time and ends: {} s unless --program says otherwise. Its own statements are: at its\n"
        "beginning it adds 1 to the 32-bit counter in relay m at byte {} (ml{}), at its good end to the one at byte {},\n"
        "when it fails or is given up to the one at byte {}; byte {} holds the number of the program that ended last.\n"
        "Read them with GET /project/plc/m/val_s32?st={}&len=4.",
        std::chrono::duration_cast<std::chrono::seconds>(ProgramSpec{}.duration).count(),
        STARTED_BYTE,
        STARTED_BYTE / sizeof(std::int32_t),
        FINISHED_BYTE,
        FAILED_BYTE,
        LAST_BYTE,
        STARTED_BYTE);
}

} // namespace

std::string TakeProgram(std::string_view text, ControllerOptions& options)
{
    std::string mistake = fmt::format(
        "expected NUMBER=DURATION[,fail] with a number from {} to {} (11=3s), found '{}'",
        FIRST_PROGRAM,
        LAST_PROGRAM,
        text);
    const std::size_t equals = text.find('=');
    const std::optional<int> number = ParseProgramNumberOrNull(text.substr(0, equals));
    if (equals == std::string_view::npos || !number.has_value())
    {
        return mistake;
    }
    ProgramSpec spec;
    std::string_view rest = text.substr(equals + 1);
    spec.bFails = rest.ends_with(FAIL_SUFFIX);
    rest.remove_suffix(spec.bFails ? FAIL_SUFFIX.size() : 0);
    const Core::Result<std::chrono::milliseconds> duration = Apps::ParseDuration(rest);
    if (!duration.has_value() || duration->count() == 0)
    {
        return mistake;
    }
    spec.duration = *duration;
    if (!options.programs.emplace(*number, spec).second)
    {
        return fmt::format("program {} is given twice", *number);
    }
    return {};
}

std::optional<int> ParseOptionsOrNull(int argc, const char* const* argv, OpenStreamSimOptions& options)
{
    CLI::App app{
        "A Hi6 robot controller in memory: serves the Open Stream and the HTTP Open API over one simulated six-axis arm.",
        std::string(PROGRAM_NAME)};
    app.footer(MakeFooter());
    Apps::AddEndpointOption(
        app,
        "--listen",
        options.host.stream,
        "Where to serve the Open Stream; port 0 takes a free one");
    Apps::AddEndpointOption(app, "--http", options.host.http, "Where to serve the Open API; port 0 takes a free one");
    Apps::AddTimeScaleOption(app, options.host.controller.timeScale);
    Apps::AddRepeatedOption(
        app,
        "--program",
        [&options](const std::string& text) { return TakeProgram(text, options.host.controller); },
        "How long a program takes, and whether it fails at its end: 11=3s or 12=500ms,fail")
        .type_name("NUMBER=DURATION[,fail]");
    app.add_flag("--ready", options.host.controller.bMotorOn, "Begin with the motor on");
    app.add_flag(
        "--playing",
        options.host.controller.bWaiting,
        "Begin with the motor on and a program in playback that waits for di1, so that trajectories are taken");
    app.add_flag(
        "--realtime",
        options.bRealTime,
        "Ask the system for a real-time priority, precise timers and locked memory; go on without what it refuses");
    Apps::AddCommonOptions(app, options.common);
    return Apps::ParseCommandLineOrNull(app, argc, argv);
}

} // namespace ACS::OpenStreamSim
