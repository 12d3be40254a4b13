#include "vda-sim/WorldWatch.hpp"

#include <optional>
#include <utility>

namespace ACS::VdaSim
{

WorldWatch::WorldWatch(Sim::IWorld& world, Core::Logger logger)
    : _world(&world),
      _logger(std::move(logger))
{
}

bool WorldWatch::HasChanged()
{
    const bool bChanged = !_world->TakeEvents().empty();
    const std::optional<Core::Error> failed = _world->GetFailureOrNull();
    std::string failure = failed.has_value() ? Core::Describe(*failed) : std::string();
    if (failure != _failure)
    {
        _failure = std::move(failure);
        if (_failure.empty())
        {
            _logger.Info("the journal of the world is readable again");
        }
        else
        {
            _logger.Error("cannot read the journal of the world: picks and drops fail", {{"reason", _failure}});
        }
    }
    return bChanged;
}

} // namespace ACS::VdaSim
