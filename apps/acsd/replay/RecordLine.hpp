#pragma once

#include "replay/CoreRecord.hpp"
#include "trace/MessageTrace.hpp"
#include <acs/core/Result.hpp>

#include <cstdint>
#include <optional>
#include <string_view>
#include <variant>

namespace ACS::Acsd
{

/// A line of the trace that states a number of lost lines.
struct LostLines
{
    std::uint64_t count = 0;
};

/// Adds the record to the trace.
void WriteRecord(const CoreRecord& record, MessageTrace& trace);

/// Reads a line of the trace. nullopt: it is a message, or of another kind that is no record. Fails for any other line.
[[nodiscard]] Core::Result<std::optional<std::variant<CoreRecord, LostLines>>> ReadRecord(std::string_view line);

} // namespace ACS::Acsd
