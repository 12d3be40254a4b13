#include "replay/ReplayCommand.hpp"

#include "common/config/CommandLine.hpp"
#include "common/log/LogText.hpp"
#include "common/Version.hpp"
#include "replay/CoreReplay.hpp"
#include "replay/RecordedConfig.hpp"
#include "replay/ReplayFiles.hpp"
#include <acs/core/Timestamp.hpp>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>

namespace ACS::Acsd
{

namespace
{

constexpr const char* REPLAY_NAME = "acsd replay";
constexpr int DIFFERENCE = 1;
constexpr int UNREADABLE = 2;

/// A folder for the files of a recorded configuration, removed at the end.
class TemporaryFolder final
{
    std::string _path;

public:
    TemporaryFolder()
        : _path((std::filesystem::temp_directory_path() / "acsd-replay-XXXXXX").string())
    {
        if (::mkdtemp(_path.data()) == nullptr)
        {
            _path.clear();
        }
    }

    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    ~TemporaryFolder()
    {
        std::error_code ignored;
        if (!_path.empty())
        {
            std::filesystem::remove_all(_path, ignored);
        }
    }

    /// Empty: it could not be created.
    [[nodiscard]] const std::string& GetPath() const noexcept
    {
        return _path;
    }
};

/// Around the first byte in which they differ: a text may be long.
std::string Shorten(const std::string& text, const std::string& other)
{
    constexpr std::ptrdiff_t BEFORE = 200;
    constexpr std::size_t MOST = 600;
    const auto different = std::ranges::mismatch(text, other).in1;
    const auto at = std::max<std::ptrdiff_t>(std::distance(text.begin(), different) - BEFORE, 0);
    const std::string part = text.substr(static_cast<std::size_t>(at), MOST);
    const bool bCut = static_cast<std::size_t>(at) + MOST < text.size();
    return fmt::format("{}{}{}", at > 0 ? "..." : "", Apps::MakePrintable(part), bCut ? "..." : "");
}

void PrintDifference(const ReplayDifference& difference, std::size_t inputs)
{
    fmt::print(
        "first difference at {}, input {} ({})\n  input:    {}\n  expected: {}\n  actual:   {}\n",
        Core::FormatUTC(difference.now.wall),
        inputs,
        Apps::MakePrintable(difference.place),
        Shorten(difference.input, {}),
        Shorten(difference.expected, difference.actual),
        Shorten(difference.actual, difference.expected));
}

/// Prints how far it has come, at most once per second.
class Progress final
{
    std::chrono::steady_clock::time_point _printed = std::chrono::steady_clock::now();
    std::size_t _records = 0;

public:
    void OnRecord(const CoreRecord& record)
    {
        constexpr std::size_t INTERVAL = 1'000;
        ++_records;
        if (_records % INTERVAL != 0)
        {
            return;
        }
        const auto now = std::chrono::steady_clock::now();
        if (now - _printed >= std::chrono::seconds(1))
        {
            _printed = now;
            fmt::print(stderr, "{}: {} records\n", Core::FormatUTC(record.now.wall), _records);
        }
    }
};

int ReplayRun(const CoreRecord& begin, ReplayFiles& files, const RobotDrivers& drivers)
{
    Core::Result<RecordedRun> run = DecodeBegin(begin.text);
    if (!run.has_value())
    {
        Apps::PrintError(REPLAY_NAME, fmt::format("{}: {}", begin.place, Core::Describe(run.error())));
        return UNREADABLE;
    }
    fmt::print(
        "run of {} ({}), acsd {}\n",
        Core::FormatUTC(begin.now.wall),
        Apps::MakePrintable(begin.place),
        Apps::MakePrintable(run->version));
    if (run->version != Apps::VERSION)
    {
        fmt::print("recorded by another version than this one ({}): differences may be intended\n", Apps::VERSION);
    }
    const TemporaryFolder folder;
    const AcsdConfig config = ReadRecordedConfig(*run, folder.GetPath(), drivers);
    if (!config.errors.empty())
    {
        Apps::PrintError(
            REPLAY_NAME,
            fmt::format("the recorded configuration is invalid here: {}", config.errors.front()));
        return UNREADABLE;
    }
    Progress progress;
    CoreReplay replay(
        config,
        [&files, &progress] {
            std::optional<CoreRecord> record = files.ReadNextOrNull();
            if (record.has_value())
            {
                progress.OnRecord(*record);
            }
            return record;
        },
        [&run, &folder, &drivers](const std::string& text) {
            RecordedRun reloaded = *run;
            reloaded.config = text;
            return ReadRecordedConfig(reloaded, folder.GetPath(), drivers);
        });
    const ReplayOutcome outcome = replay.Run();
    fmt::print("{} inputs replayed", outcome.inputs);
    if (outcome.firstOrNull.has_value())
    {
        const std::chrono::duration<double> span = outcome.lastOrNull->steady - outcome.firstOrNull->steady;
        fmt::print(", {:.1f} s of the recorded run", span.count());
    }
    fmt::print("\n");
    if (outcome.differenceOrNull.has_value())
    {
        PrintDifference(*outcome.differenceOrNull, outcome.inputs);
        return DIFFERENCE;
    }
    const std::string& fault = outcome.fault.empty() ? files.GetFault() : outcome.fault;
    if (!fault.empty())
    {
        fmt::print("no difference up to there: {} reports, {} commands\n", outcome.reports, outcome.commands);
        Apps::PrintError(REPLAY_NAME, fault);
        return UNREADABLE;
    }
    fmt::print("no difference: {} reports, {} commands\n", outcome.reports, outcome.commands);
    return 0;
}

} // namespace

int RunReplayCommand(int argc, const char* const* argv, const RobotDrivers& drivers)
{
    CLI::App app{
        "Repeats a recorded run (acsd --trace DIR) in virtual time, without links and without a store, and shows the first "
        "difference between what acsd did and what this acsd does.",
        REPLAY_NAME};
    std::string path;
    app.add_option("TRACE", path, "file of a trace, or folder with all files of one")->required();
    app.footer(
        "A run can be replayed while the file with its beginning exists: trace.max_files limits how long it does.\n"
        "Exit codes: 0 without a difference; 1 with one; 2 if the trace cannot be replayed, or not to its end, and for an error "
        "in the command line.");
    const std::optional<int> exitCodeOrNull = Apps::ParseCommandLineOrNull(app, argc, argv, UNREADABLE);
    if (exitCodeOrNull.has_value())
    {
        return *exitCodeOrNull;
    }
    Core::Result<ReplayFiles> files = ReplayFiles::Open(path);
    if (!files.has_value())
    {
        Apps::PrintError(REPLAY_NAME, Core::Describe(files.error()));
        return UNREADABLE;
    }
    std::size_t runs = 0;
    int exitCode = 0;
    while (const std::optional<CoreRecord> begin = files->FindRunOrNull())
    {
        ++runs;
        const int outcome = ReplayRun(*begin, *files, drivers);
        if (outcome == DIFFERENCE)
        {
            return outcome;
        }
        exitCode = std::max(exitCode, outcome);
    }
    if (const std::string reason = files->DescribeForeign(); runs == 0 && !reason.empty())
    {
        Apps::PrintError(REPLAY_NAME, fmt::format("{}: {}", path, reason));
        return UNREADABLE;
    }
    if (runs == 0)
    {
        Apps::PrintError(
            REPLAY_NAME,
            fmt::format(
                "{}: the beginning of the run is missing: give the folder with all files, or keep more of them "
                "(trace.max_files)",
                path));
        return UNREADABLE;
    }
    return exitCode;
}

} // namespace ACS::Acsd
