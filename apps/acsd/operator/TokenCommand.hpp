#pragma once

namespace ACS::Acsd
{

/// The command `acsd token ROLE NAME`; argv[0] is its name. Returns the exit code.
[[nodiscard]] int RunTokenCommand(int argc, const char* const* argv);

} // namespace ACS::Acsd
