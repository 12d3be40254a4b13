#pragma once

namespace ACS::OpenStreamSim
{

/// Reads the command line of openstream-sim and runs its event loop. Returns the exit code: 0 after a clean end, 1 if it
/// cannot listen, 2 for an error in the command line or a file.
[[nodiscard]] int RunOpenStreamSim(int argc, const char* const* argv);

} // namespace ACS::OpenStreamSim
