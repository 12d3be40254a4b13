#include "AcsSamples.hpp"
#include "CodecTable.hpp"
#include "NlohmannCodec.hpp"
#include <acs/protocol/AcsCodec.hpp>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Bench
{

namespace
{

using Protocol::AcsCodec;
using Protocol::AcsRequest;

/// A message of the table, in the compact form in which it is sent.
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

std::vector<CodecRow> MakeRows()
{
    std::vector<CodecRow> rows;
    for (const Sample& sample : GetSamples())
    {
        rows.push_back(CodecRow{
            sample.name,
            sample.text,
            [&sample](benchmark::State& state) { DecodeTyped(state, sample); },
            [&sample](benchmark::State& state) { EncodeTyped(state, sample); },
            [&sample](benchmark::State& state) { DecodeWithNlohmann(state, sample); },
            [&sample](benchmark::State& state) {
                EncodeWithNlohmann(state, sample);
            }});
    }
    return rows;
}

} // namespace

} // namespace ACS::Bench

int main(int argumentCount, char** arguments)
{
    return ACS::Bench::RunCodecTable(argumentCount, arguments, ACS::Bench::MakeRows());
}
