#include "store/StoreWatch.hpp"

#include <fmt/format.h>

#include <utility>

namespace ACS::Acsd
{

StoreWatch::StoreWatch(Core::Logger logger)
    : _logger(std::move(logger)),
      _failures(_logger)
{
}

void StoreWatch::OnBegun(Core::SteadyTime now)
{
    _began = now;
}

void StoreWatch::OnLate()
{
    _bHangs = true;
    _logger.Error("the store does not answer: plans, controls and reports wait for it", {{"for", "5 s"}});
}

Core::Duration StoreWatch::OnStored(const Core::Result<void>& result, Core::SteadyTime now)
{
    const Core::Duration took = now - _began;
    if (std::exchange(_bHangs, false))
    {
        const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(took);
        _logger.Warning("the store has answered", {{"after", fmt::format("{} s", seconds.count())}});
    }
    if (!result.has_value())
    {
        OnLost(result.error(), now);
    }
    else if (!std::exchange(_fault, {}).empty())
    {
        _logger.Warning("the store works again");
    }
    return took;
}

void StoreWatch::OnLost(const Core::Error& error, Core::SteadyTime now)
{
    _fault = Core::Describe(error);
    _failures.Write(now, Core::ELogLevel::Error, _fault, "the store fails", {{"reason", _fault}});
}

std::optional<std::string> StoreWatch::GetFaultOrNull() const
{
    if (_bHangs)
    {
        return "the store does not answer";
    }
    return _fault.empty() ? std::nullopt : std::optional("the store cannot be written: " + _fault);
}

} // namespace ACS::Acsd
