#pragma once

namespace ACS::Acsd
{

/// acsd's command line and event loop. Returns the exit code: 0 after a clean stop, 1 if acsd cannot run, 2 for an error in
/// the command line or the configuration.
[[nodiscard]] int RunAcsd(int argc, const char* const* argv);

} // namespace ACS::Acsd
