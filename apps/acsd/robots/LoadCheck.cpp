#include "robots/LoadCheck.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

namespace ACS::Acsd
{

namespace
{

using Planning::EActionEffect;
using Planning::PortLoad;

constexpr std::string_view EMPTY = "no carrier";

std::string_view DescribeLoad(const PortLoad& load)
{
    if (!load.bLoaded)
    {
        return EMPTY;
    }
    return load.carrierID.empty() ? std::string_view("a carrier without id") : load.carrierID;
}

std::string Describe(const PortLoad& load, std::string_view expected)
{
    return fmt::format("{}: expected {}, the vehicle shows {}", load.port, expected, DescribeLoad(load));
}

} // namespace

LoadCheck::LoadCheck(const Planning::StartJob& job, EActionEffect effect)
    : _jobID(job.jobID),
      _carrierID(job.carrierID.value_or(std::string()))
{
    if (effect == EActionEffect::Load || effect == EActionEffect::Move)
    {
        _loadedPort = job.to;
    }
    if (effect == EActionEffect::Unload || effect == EActionEffect::Move)
    {
        _emptiedPort = job.from;
    }
}

const std::string& LoadCheck::GetJobID() const noexcept
{
    return _jobID;
}

std::optional<std::string> LoadCheck::FindContradictionOrNull(const std::vector<PortLoad>& loads) const
{
    for (const PortLoad& load : loads)
    {
        const bool bOther = !load.carrierID.empty() && !_carrierID.empty() && load.carrierID != _carrierID;
        if (load.port == _loadedPort && (!load.bLoaded || bOther))
        {
            return Describe(load, _carrierID.empty() ? std::string_view("a carrier") : _carrierID);
        }
        if (load.port == _emptiedPort && load.bLoaded)
        {
            return Describe(load, EMPTY);
        }
    }
    return std::nullopt;
}

ELoadEvidence LoadCheck::GetEvidence(const std::vector<PortLoad>& loads) const
{
    std::size_t ports = 0; // of the robot: the other end of a move may be a station
    std::size_t done = 0;
    std::size_t notDone = 0;
    for (const PortLoad& load : loads)
    {
        const bool bOther = !load.carrierID.empty() && !_carrierID.empty() && load.carrierID != _carrierID;
        if (load.port == _loadedPort)
        {
            ++ports;
            done += load.bLoaded && !bOther ? 1U : 0U;
            notDone += load.bLoaded ? 0U : 1U;
        }
        else if (load.port == _emptiedPort)
        {
            ++ports;
            done += load.bLoaded ? 0U : 1U;
            notDone += load.bLoaded && !bOther ? 1U : 0U;
        }
    }
    if (ports == 0 || std::max(done, notDone) < ports)
    {
        return ELoadEvidence::None;
    }
    return done == ports ? ELoadEvidence::Done : ELoadEvidence::NotDone;
}

} // namespace ACS::Acsd
