#include "LineFramer.hpp"
#include <acs/openstream/OpenStreamCodec.hpp>

#include <benchmark/benchmark.h>

#include <cstdint>
#include <optional>
#include <string>

namespace
{

using ACS::Core::JsonText;
using ACS::OpenStream::ApiResponse;
using ACS::OpenStream::LineFramer;
using ACS::OpenStream::OpenStreamCodec;

/// Like joint_states of a six-axis arm.
ApiResponse MakeJointStates()
{
    return ApiResponse{
        200,
        JsonText::FromTrusted(R"({"_type":"JObject","position":[0.949533,90.949655,-1.5,0.25,45.125,3.75],)"
                              R"("velocity":[-0.0,0.1,0.2,0.3,0.4,0.5],"effort":[0.0,93.98,94.02,0.5,0.25,0.125]})")};
}

/// The server's part of a MONITOR tick.
void EncodeMonitorData(benchmark::State& state)
{
    const ApiResponse response = MakeJointStates();
    std::string line;
    std::int64_t ts = 0;
    for (auto iteration : state)
    {
        line.clear();
        ts += 2;
        OpenStreamCodec::EncodeData(ts, 0.012345, response, std::nullopt, line);
        benchmark::DoNotOptimize(line.data());
    }
    state.SetItemsProcessed(state.iterations());
}

/// The client's part: bytes to line to message.
void FrameAndDecodeMonitorData(benchmark::State& state)
{
    std::string bytes;
    OpenStreamCodec::EncodeData(2, 0.012345, MakeJointStates(), std::nullopt, bytes);
    OpenStreamCodec codec;
    LineFramer framer(ACS::OpenStream::LONGEST_LINE);
    for (auto iteration : state)
    {
        framer.Feed(bytes);
        while (const auto line = framer.TakeLineOrNull())
        {
            benchmark::DoNotOptimize(codec.DecodeLine(*line));
        }
    }
    state.SetItemsProcessed(state.iterations());
    state.SetBytesProcessed(state.iterations() * static_cast<std::int64_t>(bytes.size()));
}

BENCHMARK(EncodeMonitorData);
BENCHMARK(FrameAndDecodeMonitorData);

} // namespace
