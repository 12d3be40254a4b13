#pragma once

namespace ACS::Acsd
{

/// `acsd store check | accept | backup | restore`; argv[0] is "store". Returns the exit code: 0 when done, 1 if the store or the
/// file does not allow it, 2 for an error in the command line.
[[nodiscard]] int RunStoreCommand(int argc, const char* const* argv);

} // namespace ACS::Acsd
