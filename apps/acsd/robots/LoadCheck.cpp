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

} // namespace ACS::Acsd
