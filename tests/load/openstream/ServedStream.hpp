#pragma once

#include "StreamKind.hpp"

#include <chrono>

namespace ACS::Load
{

/// Our server in one thread, our clients in another. False where they do not come together or lose each other: the figures
/// say why.
[[nodiscard]] bool TryRunServedTurn(const StreamKind& kind, std::chrono::milliseconds duration, StreamFigures& figures);

} // namespace ACS::Load
