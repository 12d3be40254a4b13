#include "CodecTable.hpp"

#include <fmt/format.h>
#include <rapidjson/document.h>
#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <string_view>

namespace ACS::Bench
{

namespace
{

constexpr unsigned FLAGS =
    rapidjson::kParseIterativeFlag | rapidjson::kParseValidateEncodingFlag | rapidjson::kParseFullPrecisionFlag;
constexpr double DECODE_BOUND = 1.5;
constexpr double ENCODE_BOUND = 1.0;

constexpr std::string_view DECODE = "decode";
constexpr std::string_view ENCODE = "encode";
constexpr std::string_view PARSE = "RapidJSON parse";
constexpr std::string_view WRITE = "RapidJSON write";
constexpr std::string_view NLOHMANN_DECODE = "nlohmann decode";
constexpr std::string_view NLOHMANN_ENCODE = "nlohmann encode";

void ParseWithRapidJson(benchmark::State& state, const std::string& text)
{
    for ([[maybe_unused]] auto round : state)
    {
        rapidjson::Document document;
        document.Parse<FLAGS>(text.data(), text.size());
        benchmark::DoNotOptimize(document.IsObject());
    }
}

void WriteWithRapidJson(benchmark::State& state, const std::string& text)
{
    rapidjson::Document document;
    document.Parse<FLAGS>(text.data(), text.size());
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

std::string MakeName(const CodecRow& row, std::string_view contender)
{
    return fmt::format("{}/{}", row.name, contender);
}

/// Prints as usual and keeps the fastest repetition of each, which was disturbed least.
class TableReporter final : public benchmark::ConsoleReporter
{
    const std::vector<CodecRow>& _rows;
    std::map<std::string, double> _nanoseconds;

public:
    explicit TableReporter(const std::vector<CodecRow>& rows)
        : _rows(rows)
    {
    }

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
        for (const CodecRow& row : _rows)
        {
            PrintLine(row, DECODE, PARSE, NLOHMANN_DECODE, DECODE_BOUND);
            PrintLine(row, ENCODE, WRITE, NLOHMANN_ENCODE, ENCODE_BOUND);
        }
    }

private:
    void PrintLine(
        const CodecRow& row,
        std::string_view typed,
        std::string_view bare,
        std::string_view other,
        double bound) const
    {
        const auto find = [this, &row](std::string_view contender) {
            const auto found = _nanoseconds.find(MakeName(row, contender));
            return found == _nanoseconds.end() ? 0.0 : found->second;
        };
        if (find(typed) == 0.0 || find(bare) == 0.0 || find(other) == 0.0)
        {
            return; // A filter has excluded it.
        }
        const double ratio = find(typed) / find(bare);
        fmt::print(
            "{:<22}{:>7}  {:>11.0f} {:>11.0f} {:>11.0f} {:>8.2f}x {:>8.2f}x  {} of {:.1f}x\n",
            row.name + ", " + std::string(typed),
            row.text.size(),
            find(typed),
            find(bare),
            find(other),
            ratio,
            find(typed) / find(other),
            ratio <= bound ? "within the bound" : "BEYOND the bound",
            bound);
    }
};

} // namespace

int RunCodecTable(int argumentCount, char** arguments, const std::vector<CodecRow>& rows)
{
    // Defaults that a command line replaces: the codecs alternate, so that a disturbance affects all of them.
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
    for (const CodecRow& row : rows)
    {
        const auto add = [&row](std::string_view contender, const CodecRow::Body& body) {
            benchmark::RegisterBenchmark(MakeName(row, contender).c_str(), body);
        };
        add(DECODE, row.decode);
        add(ENCODE, row.encode);
        add(PARSE, [&row](benchmark::State& state) { ParseWithRapidJson(state, row.text); });
        add(WRITE, [&row](benchmark::State& state) { WriteWithRapidJson(state, row.text); });
        add(NLOHMANN_DECODE, row.nlohmannDecode);
        add(NLOHMANN_ENCODE, row.nlohmannEncode);
    }
    TableReporter reporter(rows);
    benchmark::RunSpecifiedBenchmarks(&reporter);
    reporter.PrintTable();
    benchmark::Shutdown();
    return 0;
}

} // namespace ACS::Bench
