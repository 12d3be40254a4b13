#pragma once

#include "StreamKind.hpp"

#include <chrono>

namespace ACS::Load
{

/// Our server in one thread, our clients in another. Throws where they do not come together.
void RunServedTurn(const StreamKind& kind, std::chrono::milliseconds duration, StreamFigures& figures);

} // namespace ACS::Load
