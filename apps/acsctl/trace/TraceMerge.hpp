#pragma once

#include "trace/TraceSource.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsctl
{

/// The lines of several traces in the order of their times. Keeps one line of each in memory.
class TraceMerge final
{
    std::vector<TraceSource> _waiting; ///< Sources without a line.
    std::vector<TraceSource> _ready;   ///< Sources with a line.
    std::optional<std::size_t> _given; ///< Of the ready ones: whose line was returned.

public:
    explicit TraceMerge(std::vector<TraceSource> sources);

    /// The next line, valid until the next call; null at the end.
    [[nodiscard]] Outcome<const std::string*> ReadNextOrNull();
};

} // namespace ACS::Acsctl
