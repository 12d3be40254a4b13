#pragma once

namespace ACS::OpenStreamSim
{

/// openstream-sim's command line and event loop. Returns the exit code: 0 after a clean end, 1 when it cannot serve, 2
/// for a mistake on the command line.
[[nodiscard]] int RunOpenStreamSim(int argc, const char* const* argv);

} // namespace ACS::OpenStreamSim
