// Lesson 17: runs one program of a Hi6 controller as a job: selects it, writes its inputs, reads them back, starts it, waits
// for its end and reads back the result. Exit code: 0 finished, 1 failed, 3 not started, 4 unknown.
//
//     openstream-sim --ready --programs examples/site/programs.toml
//     e17_arm_job 127.0.0.1 49000 11 ml106=1 ml107=2 ml108=1 ml109=1
//
// One MONITOR reads all words: what the program writes (ml100 to ml104) and its inputs (ml105 to ml115). An input, and the
// start, count only when a later sample shows them. The counters show the end even if the connection was lost meanwhile.
// See docs/guide/prepare-an-arm.md for such a program. The lesson is longer than 150 lines because it has each outcome.

#include "ExampleArm.hpp"
#include "ExampleClock.hpp"
#include "ExampleRandom.hpp"
#include <acs/openstream_asio/OpenStreamClient.hpp>

#include <boost/asio/io_context.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

using namespace ACS;             // NOLINT(google-build-using-namespace): an example reads better without the prefix
using namespace ACS::OpenStream; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;

namespace
{

constexpr std::chrono::seconds TIME_LIMIT{60};
constexpr std::size_t FIRST_WORD = 100; ///< ml100, at byte 400. The words are s32.
constexpr std::size_t WORDS = 16;
constexpr std::int32_t LARGEST_JOB = 2'147'483'647;

/// Indices of the words.
enum class EWord : std::uint8_t
{
    Started,
    Finished,
    Failed,
    EndedProgram, ///< The program that ended last.
    Echo,         ///< The job number that the program has read.
    JobNumber,
};

enum class EResult : std::uint8_t
{
    Finished = 0,
    Failed = 1,
    NotStarted = 3, ///< Nothing has moved.
    Unknown = 4,    ///< The program may have run: a person must look.
};

struct Input
{
    std::size_t word = 0; ///< Index.
    std::int32_t value = 0;
};

[[nodiscard]] double Get(const std::vector<double>& words, EWord word)
{
    return words[static_cast<std::size_t>(word)];
}

/// "ml106=1"; null for other texts, and for words that the program writes.
[[nodiscard]] std::optional<Input> ParseInputOrNull(std::string_view text)
{
    const std::size_t equals = std::min(text.find('='), text.size());
    const auto number =
        text.starts_with("ml") ? Core::ParseNumberOrNull<std::size_t>(text.substr(2, equals - 2)) : std::nullopt;
    const auto value =
        equals < text.size() ? Core::ParseNumberOrNull<std::int32_t>(text.substr(equals + 1)) : std::nullopt;
    constexpr std::size_t FIRST_INPUT = FIRST_WORD + static_cast<std::size_t>(EWord::JobNumber) + 1;
    const bool bInput = number && value && *number >= FIRST_INPUT && *number < FIRST_WORD + WORDS;
    return bInput ? std::optional(Input{*number - FIRST_WORD, *value}) : std::nullopt;
}

class ArmJob
{
    std::int32_t _program;
    std::int32_t _jobNumber;
    std::deque<ControlCall> _steps; ///< The first one is in flight.
    std::vector<double> _before;    ///< The words before the job; empty before the first sample.
    OpenStreamAsio::OpenStreamClient _client;

public:
    EResult result = EResult::NotStarted;
    bool bEnded = false;

    ArmJob(
        boost::asio::io_context& io,
        Core::IClock& clock,
        Core::IRandom& random,
        const OpenStreamAsio::OpenStreamClientOptions& controller,
        std::int32_t program,
        std::vector<Input> inputs)
        : _program(program),
          _jobNumber(static_cast<std::int32_t>(random.GetNext() % LARGEST_JOB) + 1),
          _client(io.get_executor(), clock, random, {}, controller, [this](const auto& event, Core::Now) {
              OnEvent(event);
          })
    {
        AddStep("/project/context/tasks[0]/set_cur_pc_idx", R"({"idx":1})");
        AddStep("/project/context/tasks[0]/cur_prog_cnt", fmt::format(R"({{"pno":{},"ext_sel":1}})", program));
        inputs.push_back({static_cast<std::size_t>(EWord::JobNumber), _jobNumber});
        for (const Input& input : inputs)
        {
            AddStep(
                "/project/plc/set_relay_value",
                fmt::format(R"({{"name":"ml{}","value":{}}})", FIRST_WORD + input.word, input.value));
            _steps.back().isConfirmed = [input](const DataLine& sample) {
                return IsWritten(ReadSample(sample), input);
            };
        }
        AddStep("/project/robot/start", "{}");
        _steps.back().isConfirmed = [this](const DataLine& sample) {
            return HasStarted(ReadSample(sample));
        };
        _client.SetMonitor(MonitorRequest{
            "/project/plc/m/val_s32",
            20ms,
            Core::JsonText::FromTrusted(
                fmt::format(R"({{"st":{},"len":{}}})", FIRST_WORD * sizeof(std::int32_t), WORDS)),
            {}});
        _client.Start();
    }

private:
    void AddStep(std::string_view url, std::string body)
    {
        ControlCall call;
        call.request = MakePost(std::string(url), std::move(body));
        _steps.push_back(std::move(call));
    }

    [[nodiscard]] static bool IsWritten(const std::vector<double>& words, const Input& input)
    {
        return words.size() == WORDS && words[input.word] == input.value;
    }

    /// The program that has begun is this job's: it has read the job number.
    [[nodiscard]] bool HasStarted(const std::vector<double>& words) const
    {
        return words.size() == WORDS && Get(words, EWord::Started) != Get(_before, EWord::Started)
            && Get(words, EWord::Echo) == _jobNumber;
    }

    void OnEvent(const ClientEvent& event)
    {
        if (const auto* const dataOrNull = std::get_if<ClientData>(&event))
        {
            OnWords(ReadSample(dataOrNull->line));
        }
        else if (const auto* const settledOrNull = std::get_if<ClientControlSettled>(&event);
                 settledOrNull != nullptr && !bEnded)
        {
            OnSettled(*settledOrNull);
        }
        else if (const auto* const lostOrNull = std::get_if<ClientLost>(&event))
        {
            fmt::print("connection lost: {}; trying again\n", lostOrNull->detail);
        }
    }

    void OnWords(const std::vector<double>& words)
    {
        if (words.size() != WORDS || bEnded)
        {
            return;
        }
        if (_before.empty())
        {
            _before = words;
            _client.SendControlCall(_steps.front());
            return;
        }
        const double finished = Get(words, EWord::Finished) - Get(_before, EWord::Finished);
        const double failed = Get(words, EWord::Failed) - Get(_before, EWord::Failed);
        const bool bOurs =
            result == EResult::Unknown && HasStarted(words) && Get(words, EWord::EndedProgram) == _program;
        const bool bBegun = Get(words, EWord::Started) != Get(_before, EWord::Started);
        if (finished == 0 && failed == 0 && (result == EResult::Unknown || !bBegun))
        {
            return;
        }
        if (!bOurs || finished + failed != 1)
        {
            End(result, "another program has run");
        }
        else
        {
            End(finished == 1 ? EResult::Finished : EResult::Failed,
                fmt::format("echo {:.0f}", Get(words, EWord::Echo)));
        }
    }

    void OnSettled(const ClientControlSettled& settled)
    {
        const bool bStart = _steps.size() == 1;
        if (settled.outcome == EControlOutcome::Accepted)
        {
            _steps.pop_front();
            if (!_steps.empty())
            {
                // From the start on the result is unknown until the counters show it.
                result = _steps.size() == 1 ? EResult::Unknown : EResult::NotStarted;
                _client.SendControlCall(_steps.front());
            }
        }
        else if (
            bStart && (settled.outcome == EControlOutcome::Unknown || settled.outcome == EControlOutcome::Unconfirmed))
        {
            fmt::print("start: {}; the counters will show it\n", settled.detail);
        }
        else
        {
            End(EResult::NotStarted, fmt::format("{}: {}", _steps.front().request.url, settled.detail));
        }
    }

    void End(EResult how, const std::string& detail)
    {
        constexpr std::array<std::string_view, 5> TEXTS{"finished", "failed", "", "not started", "unknown"};
        bEnded = true;
        result = how;
        fmt::print(
            "program {} {}, job {}: {}\n",
            _program,
            TEXTS.at(static_cast<std::size_t>(how)),
            _jobNumber,
            detail);
        _client.Stop(); // Now the io_context runs out of work and main continues.
    }
};

} // namespace

int main(int argc, char** argv) // NOLINT(bugprone-exception-escape): nothing throws here but a full memory
{
    const std::span<char*> arguments(argv, static_cast<std::size_t>(argc));
    const auto controllerOrNull = argc > 3 ? ReadControllerOrNull(arguments[1], arguments[2]) : std::nullopt;
    const auto program = argc > 3 ? Core::ParseNumberOrNull<std::int32_t>(arguments[3]) : std::nullopt;
    std::vector<Input> inputs;
    bool bValid = controllerOrNull.has_value() && program.has_value();
    for (const char* const text : arguments.subspan(std::min<std::size_t>(arguments.size(), 4)))
    {
        const std::optional<Input> input = ParseInputOrNull(text);
        bValid = bValid && input.has_value();
        inputs.push_back(input.value_or(Input{}));
    }
    if (!bValid)
    {
        fmt::print("Usage: e17_arm_job HOST PORT PROGRAM [ml106=VALUE ... ml115=VALUE]\n");
        return 2;
    }
    boost::asio::io_context io;
    ExampleClock clock;
    ExampleRandom random;
    const ArmJob job(io, clock, random, *controllerOrNull, *program, std::move(inputs));
    io.run_for(TIME_LIMIT);
    if (!job.bEnded)
    {
        fmt::print("no end within {} s\n", TIME_LIMIT.count());
    }
    return static_cast<int>(job.result);
}
