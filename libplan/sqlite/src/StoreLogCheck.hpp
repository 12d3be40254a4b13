#pragma once

#include <string>

namespace ACS::Planning
{

/// Whether the write-ahead log of a database that was not closed has lost transactions that were committed. SQLite ignores all
/// frames from the first invalid one on. After a crash that may be the unfinished transaction at the end, but no log that is
/// shorter than a frame, has no valid header, or has several commits after the first invalid frame. False for a file that cannot be
/// read, or that another program restarts meanwhile.
[[nodiscard]] bool IsLogDamaged(const std::string& log);

} // namespace ACS::Planning
