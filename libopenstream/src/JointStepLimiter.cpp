#include <acs/openstream/JointStepLimiter.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ACS::OpenStream
{

JointStepLimiter::JointStepLimiter(std::vector<double> largestSteps)
    : _largestSteps(std::move(largestSteps))
{
}

void JointStepLimiter::Begin(std::span<const double> position)
{
    _last.assign(position.begin(), position.end());
}

std::span<const double> JointStepLimiter::Limit(std::span<const double> wanted)
{
    _bLimited = false;
    const std::size_t known = _last.size();
    _last.resize(std::max(known, wanted.size()), 0.0);
    for (std::size_t joint = 0; joint < wanted.size(); ++joint)
    {
        double& value = _last[joint];
        const bool bBounded = joint < known && joint < _largestSteps.size();
        if (!std::isfinite(wanted[joint]) || (bBounded && !std::isfinite(value)))
        {
            _bLimited = true;
            continue;
        }
        const double step = bBounded && _largestSteps[joint] > 0.0 ? _largestSteps[joint] : 0.0;
        const double next = bBounded ? std::clamp(wanted[joint], value - step, value + step) : wanted[joint];
        _bLimited = _bLimited || next != wanted[joint];
        value = next;
    }
    return std::span<const double>(_last).first(wanted.size());
}

bool JointStepLimiter::WasLimited() const noexcept
{
    return _bLimited;
}

} // namespace ACS::OpenStream
