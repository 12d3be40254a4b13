#pragma once

#include "StreamKind.hpp"

#include <chrono>

namespace ACS::Load
{

/// The minimum for two programs: a timer loop writes a line in each period over the loopback to a reader that records its
/// arrival.
void RunBareTurn(std::chrono::milliseconds duration, StreamMetrics& metrics);

} // namespace ACS::Load
