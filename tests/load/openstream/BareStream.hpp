#pragma once

#include "StreamKind.hpp"

#include <chrono>

namespace ACS::Load
{

/// The least that two programs need: a timer loop writes a line at each period, over the loopback, to a reader that notes
/// when it came.
void RunBareTurn(std::chrono::milliseconds duration, StreamFigures& figures);

} // namespace ACS::Load
