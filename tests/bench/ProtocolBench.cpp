#include "AcsSamples.hpp"
#include "NlohmannCodec.hpp"
#include <acs/protocol/AcsCodec.hpp>

#include <benchmark/benchmark.h>
#include <fmt/format.h>
#include <rapidjson/document.h>
#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

// The typed codec beside RapidJSON's bare document and nlohmann-json with conversion, in one run on the same bytes. The
// table at the end is what the codec is held to: decode at most 1.5 times the parse, encode at most the serialisation.

namespace ACS::Bench
{

namespace
{

using Protocol::AcsCodec;
using Protocol::AcsRequest;

constexpr unsigned FLAGS =
    rapidjson::kParseIterativeFlag | rapidjson::kParseValidateEncodingFlag | rapidjson::kParseFullPrecisionFlag;
constexpr double DECODE_BOUND = 1.5;
constexpr double ENCODE_BOUND = 1.0;

/// A message of the table, in the compact form in which it crosses the wire.
struct Sample
{
    std::string name;
    AcsRequest request;
    std::string text;
};

AcsRequest DecodeOrThrow(std::string_view text)
{
    AcsCodec codec;
    const Protocol::DecodeOutcome outcome = codec.Decode(text);
    if (!outcome.message.has_value())
    {
        throw std::runtime_error("a sample does not decode");
    }
    return std::get<AcsRequest>(*outcome.message);
}

Sample MakeSample(const std::string& name, const AcsRequest& request)
{
    Sample sample{name, request, {}};
    AcsCodec::EncodeRequest(request, sample.text);
    // All of them must do the same work.
    if (!(DecodeOrThrow(sample.text) == request) || !(NlohmannCodec::Decode(sample.text) == request)
        || !(DecodeOrThrow(NlohmannCodec::Encode(request)) == request))
    {
        throw std::runtime_error("the codecs do not agree about " + name);
    }
    return sample;
}

const std::vector<Sample>& GetSamples()
{
    static const std::vector<Sample> SAMPLES = [] {
        std::ifstream file(ACS_FIXTURES "/acs/ExecutionPlanCR.json", std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
        return std::vector<Sample>{
            MakeSample("plan of section 6.4", DecodeOrThrow(text)),
            MakeSample("plan of 75 jobs", Testing::MakeLargePlan()),
            MakeSample("50 positions", Testing::MakeFiftyPositions())};
    }();
    return SAMPLES;
}

void DecodeTyped(benchmark::State& state, const Sample& sample)
{
    AcsCodec codec;
    for ([[maybe_unused]] auto round : state)
    {
        benchmark::DoNotOptimize(codec.Decode(sample.text));
    }
}

void EncodeTyped(benchmark::State& state, const Sample& sample)
{
    std::string out;
    for ([[maybe_unused]] auto round : state)
    {
        AcsCodec::EncodeRequest(sample.request, out);
        benchmark::DoNotOptimize(out.data());
        benchmark::ClobberMemory();
    }
}

void ParseWithRapidJson(benchmark::State& state, const Sample& sample)
{
    for ([[maybe_unused]] auto round : state)
    {
        rapidjson::Document document;
        document.Parse<FLAGS>(sample.text.data(), sample.text.size());
        benchmark::DoNotOptimize(document.IsObject());
    }
}

void WriteWithRapidJson(benchmark::State& state, const Sample& sample)
{
    rapidjson::Document document;
    document.Parse<FLAGS>(sample.text.data(), sample.text.size());
    rapidjson::StringBuffer buffer;
    for ([[maybe_unused]] auto round : state)
    {
        buffer.Clear();
        rapidjson::Writer<rapidjson::StringBuffer> writer(buffer);
        document.Accept(writer);
        benchmark::DoNotOptimize(buffer.GetString());
        benchmark::ClobberMemory();
    }
}

void DecodeWithNlohmann(benchmark::State& state, const Sample& sample)
{
    for ([[maybe_unused]] auto round : state)
    {
        benchmark::DoNotOptimize(NlohmannCodec::Decode(sample.text));
    }
}

void EncodeWithNlohmann(benchmark::State& state, const Sample& sample)
{
    for ([[maybe_unused]] auto round : state)
    {
        benchmark::DoNotOptimize(NlohmannCodec::Encode(sample.request));
    }
}

struct Contender
{
    std::string_view name;
    void (*run)(benchmark::State& state, const Sample& sample);
};

constexpr std::array<Contender, 6> CONTENDERS{{
    {"decode", &DecodeTyped},
    {"encode", &EncodeTyped},
    {"RapidJSON parse", &ParseWithRapidJson},
    {"RapidJSON write", &WriteWithRapidJson},
    {"nlohmann decode", &DecodeWithNlohmann},
    {"nlohmann encode", &EncodeWithNlohmann},
}};

std::string MakeName(const Sample& sample, std::string_view contender)
{
    return fmt::format("{}/{}", sample.name, contender);
}

/// Prints as usual and keeps the fastest repetition of each, the one that was disturbed least.
class TableReporter final : public benchmark::ConsoleReporter
{
    std::map<std::string, double> _nanoseconds;

public:
    // Google Benchmark's names.
    void ReportRuns(const std::vector<Run>& reports) override // NOLINT(readability-identifier-naming)
    {
        for (const Run& run : reports)
        {
            if (run.run_type == Run::RT_Iteration && !run.error_occurred)
            {
                const auto [found, bNew] =
                    _nanoseconds.try_emplace(run.run_name.function_name, run.GetAdjustedCPUTime());
                found->second = std::min(found->second, run.GetAdjustedCPUTime());
            }
        }
        ConsoleReporter::ReportRuns(reports);
    }

    void PrintTable() const
    {
        fmt::print(
            "\n{:<22}{:>7}  {:>11} {:>11} {:>11} {:>9} {:>9}\n",
            "message",
            "bytes",
            "typed ns",
            "RapidJSON",
            "nlohmann",
            "of Rapid",
            "of nlohm");
        for (const Sample& sample : GetSamples())
        {
            PrintLine(sample, "decode", "RapidJSON parse", "nlohmann decode", DECODE_BOUND);
            PrintLine(sample, "encode", "RapidJSON write", "nlohmann encode", ENCODE_BOUND);
        }
    }

private:
    void PrintLine(
        const Sample& sample,
        std::string_view typed,
        std::string_view bare,
        std::string_view other,
        double bound) const
    {
        const auto find = [this, &sample](std::string_view contender) {
            const auto found = _nanoseconds.find(MakeName(sample, contender));
            return found == _nanoseconds.end() ? 0.0 : found->second;
        };
        if (find(typed) == 0.0 || find(bare) == 0.0 || find(other) == 0.0)
        {
            return; // A filter has left it out.
        }
        const double ratio = find(typed) / find(bare);
        fmt::print(
            "{:<22}{:>7}  {:>11.0f} {:>11.0f} {:>11.0f} {:>8.2f}x {:>8.2f}x  {} of {:.1f}x\n",
            sample.name + ", " + std::string(typed),
            sample.text.size(),
            find(typed),
            find(bare),
            find(other),
            ratio,
            find(typed) / find(other),
            ratio <= bound ? "within the bound" : "BEYOND the bound",
            bound);
    }
};

int Run(int argumentCount, char** arguments)
{
    // Defaults that a command line replaces: the contenders in turns, so that a busy moment hits all alike.
    std::vector<std::string> defaults{
        "--benchmark_repetitions=5",
        "--benchmark_enable_random_interleaving=true",
        "--benchmark_min_time=0.1"};
    std::vector<char*> all{arguments[0]};
    std::ranges::transform(defaults, std::back_inserter(all), [](std::string& option) { return option.data(); });
    all.insert(all.end(), arguments + 1, arguments + argumentCount);
    int count = static_cast<int>(all.size());
    benchmark::Initialize(&count, all.data());
    if (benchmark::ReportUnrecognizedArguments(count, all.data()))
    {
        return 1;
    }
    for (const Sample& sample : GetSamples())
    {
        for (const Contender& contender : CONTENDERS)
        {
            benchmark::RegisterBenchmark(MakeName(sample, contender.name).c_str(), contender.run, sample);
        }
    }
    TableReporter reporter;
    benchmark::RunSpecifiedBenchmarks(&reporter);
    reporter.PrintTable();
    benchmark::Shutdown();
    return 0;
}

} // namespace

} // namespace ACS::Bench

int main(int argumentCount, char** arguments)
{
    return ACS::Bench::Run(argumentCount, arguments);
}
