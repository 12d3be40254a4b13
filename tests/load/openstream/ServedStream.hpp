#pragma once

#include "StreamKind.hpp"

#include <chrono>

namespace ACS::Load
{

/// Runs the server in one thread and the clients in another. False if they do not connect or a connection is lost: the
/// metrics have the reason.
[[nodiscard]] bool TryRunServedTurn(const StreamKind& kind, std::chrono::milliseconds duration, StreamMetrics& metrics);

} // namespace ACS::Load
