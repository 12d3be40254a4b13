#pragma once

#include <benchmark/benchmark.h>

#include <functional>
#include <string>
#include <vector>

namespace ACS::Bench
{

/// A message of a table that compares a typed codec with RapidJSON's bare document and nlohmann-json with conversion,
/// in one run on the same bytes: text is the message in the compact form in which it is sent.
struct CodecRow
{
    using Body = std::function<void(benchmark::State&)>;

    std::string name;
    std::string text;
    Body decode;
    Body encode;
    Body nlohmannDecode;
    Body nlohmannEncode;
};

/// Measures the rows, by the options of Google Benchmark, and prints the table with the bounds of a typed codec: decode
/// at most 1.5 times the parse, encode at most the serialisation. Returns the program's exit code.
[[nodiscard]] int RunCodecTable(int argumentCount, char** arguments, const std::vector<CodecRow>& rows);

} // namespace ACS::Bench
