#pragma once

#include <cstddef>

namespace ACS::McsSim
{

/// How a simulated MCS deviates from the specification; by default it does not.
struct McsBehaviour
{
    /// Of a longer text only the last chunk of this size is read, as if it were the whole text; 0: every text is read
    /// whole.
    std::size_t finalChunkBytes = 0;
    bool bErrorsUnanswered = false; ///< A request that is not understood or not allowed gets no Ack.
    bool bPositionsUnknown = false; ///< RobotPositionUpdate is an unknown command.
    bool bNullResults = false;      ///< Requests carry `"result":null,"message":null`.

    bool operator==(const McsBehaviour&) const = default;
};

} // namespace ACS::McsSim
