#include <acs/json/JsonDocument.hpp>
#include <acs/protocol/AcsCodec.hpp>

#include <benchmark/benchmark.h>
#include <rapidjson/document.h>
#include <rapidjson/stringbuffer.h>
#include <rapidjson/writer.h>

#include <cstdint>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

namespace ACS::Bench
{

namespace
{

constexpr unsigned FLAGS =
    rapidjson::kParseIterativeFlag | rapidjson::kParseValidateEncodingFlag | rapidjson::kParseFullPrecisionFlag;

/// The control robot's plan of section 6.4, in the compact form in which it crosses the wire.
std::string MakePlanText()
{
    std::ifstream file(ACS_FIXTURES "/acs/ExecutionPlanCR.json", std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
    Protocol::AcsCodec codec;
    const Protocol::DecodeOutcome outcome = codec.Decode(text);
    if (!outcome.message.has_value())
    {
        throw std::runtime_error("the fixture does not decode");
    }
    std::string compact;
    Protocol::AcsCodec::Encode(*outcome.message, compact);
    return compact;
}

void SetBytes(benchmark::State& state, const std::string& text)
{
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(text.size()));
}

void DecodePlan(benchmark::State& state)
{
    const std::string text = MakePlanText();
    Protocol::AcsCodec codec;
    for ([[maybe_unused]] auto round : state)
    {
        benchmark::DoNotOptimize(codec.Decode(text));
    }
    SetBytes(state, text);
}

void ParsePlanWithRapidJson(benchmark::State& state)
{
    const std::string text = MakePlanText();
    for ([[maybe_unused]] auto round : state)
    {
        rapidjson::Document document;
        document.Parse<FLAGS>(text.data(), text.size());
        benchmark::DoNotOptimize(document.IsObject());
    }
    SetBytes(state, text);
}

void EncodePlan(benchmark::State& state)
{
    const std::string text = MakePlanText();
    Protocol::AcsCodec codec;
    const Protocol::DecodeOutcome outcome = codec.Decode(text);
    std::string out;
    for ([[maybe_unused]] auto round : state)
    {
        Protocol::AcsCodec::Encode(*outcome.message, out);
        benchmark::DoNotOptimize(out.data());
    }
    SetBytes(state, text);
}

void WritePlanWithRapidJson(benchmark::State& state)
{
    const std::string text = MakePlanText();
    rapidjson::Document document;
    document.Parse<FLAGS>(text.data(), text.size());
    rapidjson::StringBuffer buffer;
    for ([[maybe_unused]] auto round : state)
    {
        buffer.Clear();
        rapidjson::Writer<rapidjson::StringBuffer> writer(buffer);
        document.Accept(writer);
        benchmark::DoNotOptimize(buffer.GetString());
    }
    SetBytes(state, text);
}

BENCHMARK(DecodePlan);
BENCHMARK(ParsePlanWithRapidJson);
BENCHMARK(EncodePlan);
BENCHMARK(WritePlanWithRapidJson);

} // namespace

} // namespace ACS::Bench
