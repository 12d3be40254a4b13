#pragma once

#include <cstdint>
#include <sys/types.h>

/// Resource usage of a process, as reported by the system.
namespace ACS::Load::ProcessProbe
{

/// CPU time used so far, in seconds.
[[nodiscard]] double GetCpuSeconds(pid_t process);

/// Resident memory in KiB.
[[nodiscard]] std::int64_t GetResidentKiB(pid_t process);

/// Pins the process, and the threads that it starts from now on, to one core; no effect if there is no such core.
void KeepOnCore(pid_t process, std::size_t core);

} // namespace ACS::Load::ProcessProbe
