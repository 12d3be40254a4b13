#include "programs/FloorWork.hpp"

#include <cassert>
#include <string_view>
#include <utility>

namespace ACS::OpenStreamSim
{

namespace
{

using PlannedEvent = Core::Result<std::optional<Sim::WorldEvent>>;

/// The place of the first template that applies; else the error is that of the last one.
Core::Result<std::string> ReadPlace(
    const PlaceTemplates& templates,
    const RelayMemory& relays,
    std::string_view robotID)
{
    assert(!templates.empty());
    Core::Result<std::string> place;
    for (const PlaceTemplate& candidate : templates)
    {
        place = candidate.Fill(relays, robotID);
        if (place.has_value())
        {
            break;
        }
    }
    return place;
}

PlannedEvent PlanEvent(const TransferWork& work, const RelayMemory& relays, const std::string& robotID)
{
    Core::Result<std::string> from = ReadPlace(work.from, relays, robotID);
    Core::Result<std::string> to = ReadPlace(work.to, relays, robotID);
    if (!from.has_value() || !to.has_value())
    {
        return tl::make_unexpected(from.has_value() ? to.error() : from.error());
    }
    if (work.from.front().GetKind() == Core::ESegmentKind::MemoryPort)
    {
        return Sim::MemoryMoved{robotID, std::move(*from), std::move(*to)};
    }
    return Sim::CarrierMoved{robotID, {}, std::move(*from), std::move(*to)};
}

PlannedEvent PlanEvent(const CoverWork& work, const RelayMemory& relays, const std::string& robotID)
{
    Core::Result<std::string> set = ReadPlace(work.set, relays, robotID);
    if (!set.has_value())
    {
        return tl::make_unexpected(set.error());
    }
    return Sim::CoverMoved{robotID, std::move(*set), work.bClose};
}

PlannedEvent PlanEvent(const ButtonWork& work, const RelayMemory& relays, const std::string& robotID)
{
    Core::Result<std::string> place = ReadPlace(work.place, relays, robotID);
    if (!place.has_value())
    {
        return tl::make_unexpected(place.error());
    }
    return Sim::ButtonPushed{robotID, std::move(*place)};
}

PlannedEvent PlanEvent(const std::monostate& /*work*/, const RelayMemory& /*relays*/, const std::string& /*robotID*/)
{
    return std::nullopt;
}

} // namespace

FloorWork::FloorWork(Sim::IWorld* worldOrNull, std::string robotID)
    : _world(worldOrNull),
      _robotID(std::move(robotID))
{
}

void FloorWork::Plan(const ProgramWork& work, const RelayMemory& relays)
{
    _planned = std::visit([&](const auto& kind) { return PlanEvent(kind, relays, _robotID); }, work);
}

Core::Result<void> FloorWork::Finish()
{
    const PlannedEvent planned = std::exchange(_planned, std::nullopt);
    if (!planned.has_value())
    {
        return tl::make_unexpected(planned.error());
    }
    if (!planned->has_value() || _world == nullptr)
    {
        return {};
    }
    return _world->Act(**planned);
}

} // namespace ACS::OpenStreamSim
