#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace ACS::Apps
{

/// Makes lines for a trace of the bytes of one direction of a connection.
class LineCollector final
{
public:
    using LineHandler = std::function<void(std::string_view line)>;

private:
    std::string _kept; ///< The line that is not complete yet.

public:
    /// Passes each line that the bytes complete to the handler, without its end. Empty lines are omitted. A line of more than
    /// 1 MiB is passed in pieces.
    void Add(std::string_view bytes, const LineHandler& onLine);

    /// The connection has ended: passes what has arrived of an incomplete line.
    void Finish(const LineHandler& onLine);
};

} // namespace ACS::Apps
