#include "RivalDetector.hpp"

#include "MosquittoError.hpp"

#include <utility>

namespace ACS::VDA5050
{

RivalDetector::RivalDetector(bool bUniqueID) noexcept
    : _bUniqueID(bUniqueID)
{
}

void RivalDetector::OnUp(Time now) noexcept
{
    _upSince = now;
}

RivalDetector::End RivalDetector::OnEnd(Time now, const std::error_code& reason)
{
    const std::optional<Time> upSince = std::exchange(_upSince, std::nullopt);
    End end;
    if (upSince.has_value())
    {
        end.upTime = now - *upSince;
    }
    if (IsSessionTakenOver(reason))
    {
        end.bRival = true; // known, and no sign of another one
    }
    else if (upSince.has_value())
    {
        _shortCount = end.upTime >= STABLE_AFTER ? 0 : _shortCount + 1;
        end.bRival = !_bUniqueID && _shortCount >= SUSPICIOUS_COUNT;
    }
    return end;
}

} // namespace ACS::VDA5050
