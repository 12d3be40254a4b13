#pragma once

#include <cstdint>
#include <sys/types.h>

/// What the system says of a process of ours, this one included.
namespace ACS::Load::ProcessProbe
{

/// Seconds of a core that it has used so far.
[[nodiscard]] double GetCpuSeconds(pid_t process);

/// KiB of memory that it holds now.
[[nodiscard]] std::int64_t GetResidentKiB(pid_t process);

/// Keeps it, and the threads that it starts from now on, on one core; nothing where there is no core of that number.
void KeepOnCore(pid_t process, std::size_t core);

} // namespace ACS::Load::ProcessProbe
