#pragma once

namespace ACS::Acsd
{

/// acsd's command line and event loop. Returns the exit code: 0 after a clean end, 1 when it cannot serve, 2 for a
/// mistake on the command line or in the configuration.
[[nodiscard]] int RunAcsd(int argc, const char* const* argv);

} // namespace ACS::Acsd
