#pragma once

#include "common/config/WordReader.hpp"
#include "common/faults/FaultText.hpp"
#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace ACS::Apps
{

/// One KEY=VALUE of a fault.
template <typename TFault>
struct FaultParameter
{
    std::string_view key;
    std::string_view values; ///< Placeholder in the help, such as "DURATION".
    /// Assigns the value to the fault. Returns what was expected if it is invalid, else an empty text.
    std::string (*read)(std::string_view text, TFault& fault) = nullptr;
};

/// One kind of fault.
template <typename TFault>
struct FaultRow
{
    typename TFault::Kind kind{};
    std::string_view name;
    std::string_view parameters; ///< Keys besides those of the time (when, whenOnce), between blanks.
    std::string_view effect;     ///< One sentence for the help.
    bool bOnce = false;          ///< Takes effect once and ends immediately.
};

/// The syntax of a program's faults: NAME [KEY=VALUE]... The tables are constants of the program.
template <typename TFault>
struct FaultGrammar
{
    std::string_view target;   ///< Placeholder of the first word of a command: "VEHICLE".
    std::string_view when;     ///< Keys of every kind: "at for".
    std::string_view whenOnce; ///< Keys of every kind that takes effect once: "at".
    bool bTriggers = false;    ///< Whether the command "trigger" exists.
    std::span<const FaultParameter<TFault>> parameters;
    std::span<const FaultRow<TFault>> rows;
    /// Checks the combination of the given keys; may set implied values.
    Core::Result<void> (*check)(TFault& fault, const std::set<std::string_view>& keys) = nullptr;
};

/// The shortest period of a repeated fault.
inline constexpr std::chrono::milliseconds SHORTEST_REPEAT{10};
inline constexpr std::uint32_t MAX_USES = 1'000'000;

// Parameters of more than one program.
template <typename TFault>
inline constexpr FaultParameter<TFault> FAULT_AT{"at", "DURATION", [](std::string_view text, TFault& fault) {
                                                     return ReadDurationValue(text, fault.delay);
                                                 }};
template <typename TFault>
inline constexpr FaultParameter<TFault> FAULT_FOR{"for", "DURATION", [](std::string_view text, TFault& fault) {
                                                      return ReadDurationValue(text, fault.lasts.emplace());
                                                  }};
template <typename TFault>
inline constexpr FaultParameter<TFault> FAULT_EVERY{"every", "DURATION", [](std::string_view text, TFault& fault) {
                                                        return ReadDurationValue(text, fault.every.emplace());
                                                    }};
template <typename TFault>
inline constexpr FaultParameter<TFault> FAULT_COUNT{"count", "N", [](std::string_view text, TFault& fault) {
                                                        return ReadCountValue(text, MAX_USES, fault.maxUses.emplace());
                                                    }};

template <typename TFault>
[[nodiscard]] const FaultRow<TFault>& GetFaultRow(const FaultGrammar<TFault>& grammar, typename TFault::Kind kind)
{
    return *std::ranges::find(grammar.rows, kind, &FaultRow<TFault>::kind);
}

/// Fails with ECoreError::UnknownWord and the known names.
template <typename TFault>
[[nodiscard]] Core::Result<typename TFault::Kind> ParseFaultKind(
    const FaultGrammar<TFault>& grammar,
    std::string_view name)
{
    const auto found = std::ranges::find(grammar.rows, name, &FaultRow<TFault>::name);
    if (found != grammar.rows.end())
    {
        return found->kind;
    }
    std::string names;
    for (const FaultRow<TFault>& row : grammar.rows)
    {
        names += (names.empty() ? "" : ", ") + std::string(row.name);
    }
    return Core::Fail(Core::ECoreError::UnknownWord, "fault", "one of " + names, Core::QuoteForError(name));
}

/// All keys of the kind, separated by blanks.
template <typename TFault>
[[nodiscard]] std::string MakeFaultKeys(const FaultGrammar<TFault>& grammar, const FaultRow<TFault>& row)
{
    std::string keys(row.bOnce ? grammar.whenOnce : grammar.when);
    return row.parameters.empty() ? keys : keys + " " + std::string(row.parameters);
}

/// Reads one KEY=VALUE into the fault.
template <typename TFault>
[[nodiscard]] Core::Result<void> ReadFaultParameter(
    const FaultGrammar<TFault>& grammar,
    const FaultRow<TFault>& row,
    std::string_view word,
    TFault& fault)
{
    const std::size_t equals = word.find('=');
    const std::string_view key = word.substr(0, equals);
    const auto found = std::ranges::find(grammar.parameters, key, &FaultParameter<TFault>::key);
    const std::string keys = MakeFaultKeys(grammar, row);
    if (equals == std::string_view::npos || found == grammar.parameters.end() || !ContainsWord(keys, key))
    {
        return Core::Fail(
            Core::ECoreError::UnknownWord,
            std::string(row.name),
            fmt::format("KEY=VALUE with a key of: {}", keys),
            Core::QuoteForError(word));
    }
    const std::string_view value = word.substr(equals + 1);
    std::string expected = found->read(value, fault);
    if (!expected.empty())
    {
        return Core::Fail(
            Core::ECoreError::OutOfRange,
            fmt::format("{} {}", row.name, key),
            std::move(expected),
            Core::QuoteForError(value));
    }
    return {};
}

/// Checks that a repeated fault ends before it begins again.
template <typename TFault>
[[nodiscard]] Core::Result<void> CheckRepeat(const FaultRow<TFault>& row, const TFault& fault)
{
    const Core::Duration least = fault.lasts.value_or(Core::Duration::zero());
    const bool bEnds = row.bOnce || fault.lasts.has_value();
    if (fault.every.has_value() && (!bEnds || *fault.every <= least || *fault.every < SHORTEST_REPEAT))
    {
        return Core::Fail(
            Core::ECoreError::OutOfRange,
            fmt::format("{} every", row.name),
            fmt::format(
                "at least {} ms{}",
                SHORTEST_REPEAT.count(),
                row.bOnce ? "" : " and longer than for=DURATION, which it needs"));
    }
    return {};
}

/// Reads a fault such as "stuck at=10s for=5s". Fails with ECoreError::UnknownWord or OutOfRange; the path is the parameter.
template <typename TFault>
[[nodiscard]] Core::Result<TFault> ParseFault(const FaultGrammar<TFault>& grammar, std::string_view text)
{
    const std::string_view name = TakeWord(text);
    const Core::Result<typename TFault::Kind> kind = ParseFaultKind(grammar, name);
    if (!kind.has_value())
    {
        return tl::make_unexpected(kind.error());
    }
    const FaultRow<TFault>& row = GetFaultRow(grammar, *kind);
    TFault fault;
    fault.kind = *kind;
    fault.text = name;
    fault.bOnce = row.bOnce;
    std::set<std::string_view> keys;
    for (std::string_view word = TakeWord(text); !word.empty(); word = TakeWord(text))
    {
        const Core::Result<void> read = ReadFaultParameter(grammar, row, word, fault);
        if (!read.has_value())
        {
            return tl::make_unexpected(read.error());
        }
        if (!keys.insert(word.substr(0, word.find('='))).second)
        {
            return Core::Fail(
                Core::ECoreError::UnknownWord,
                std::string(row.name),
                "each key once",
                Core::QuoteForError(word));
        }
        fault.text.append(" ").append(word);
    }
    Core::Result<void> whole = grammar.check(fault, keys);
    whole = whole.has_value() ? CheckRepeat(row, fault) : whole;
    if (!whole.has_value())
    {
        return tl::make_unexpected(whole.error());
    }
    return fault;
}

/// The text for --help: name, parameters and effect of each kind.
template <typename TFault>
[[nodiscard]] std::string MakeFaultHelp(const FaultGrammar<TFault>& grammar)
{
    std::string help;
    for (const FaultRow<TFault>& row : grammar.rows)
    {
        std::string_view keys = row.parameters;
        std::string parameters;
        for (std::string_view key = TakeWord(keys); !key.empty(); key = TakeWord(keys))
        {
            const auto found = std::ranges::find(grammar.parameters, key, &FaultParameter<TFault>::key);
            parameters += fmt::format(" [{}={}]", key, found->values);
        }
        help += fmt::format("  {}{}\n      {}\n", row.name, parameters, row.effect);
    }
    return help;
}

} // namespace ACS::Apps
