#include "vda-sim/LoadDevice.hpp"

#include "vda-sim/VehicleFactsheet.hpp"

#include <algorithm>
#include <iterator>
#include <optional>
#include <utility>

namespace ACS::VdaSim
{
namespace
{

constexpr std::string_view KEY_STATION = "stationName";
constexpr std::string_view KEY_LOAD = "loadId";
constexpr std::string_view KEY_LOAD_TYPE = "loadType";
constexpr std::string_view KEY_POSITION = "lhd";
constexpr std::string_view NO_STATION = "the action names no station, and the node does not belong to exactly one";

} // namespace

LoadDevice::LoadDevice(std::string robotID, EVehicleType type, LoadHandling handling, Sim::IWorld* worldOrNull)
    : _robotID(std::move(robotID)),
      _handling(std::move(handling)),
      _positions(GetLoadPositions(type, _handling)),
      _worldOrNull(worldOrNull)
{
    UpdateLoads();
}

bool LoadDevice::IsPick(std::string_view actionType) const
{
    return actionType == _handling.pickType;
}

bool LoadDevice::IsDrop(std::string_view actionType) const
{
    return actionType == _handling.dropType;
}

std::string LoadDevice::GetText(const VDA5050::Action& action, std::string_view key) const
{
    const std::string_view name = _handling.GetParameterName(key);
    const VDA5050::ActionParameter* const parameter =
        name.empty() ? nullptr : VDA5050::FindParameterOrNull(action, name);
    if (parameter == nullptr)
    {
        return {};
    }
    return parameter->value.GetStringOrNull().value_or(parameter->value.GetText());
}

VDA5050::Load LoadDevice::MakeLoad(const VDA5050::Action& action) const
{
    VDA5050::Load load;
    load.loadID = GetText(action, KEY_LOAD);
    load.loadType = GetText(action, KEY_LOAD_TYPE);
    load.loadPosition = GetText(action, KEY_POSITION);
    return load;
}

bool LoadDevice::IsFree(std::string_view position) const
{
    return std::ranges::find(_loads, position, &VDA5050::Load::loadPosition) == _loads.end();
}

std::string LoadDevice::GetPort(const LoadPosition& position) const
{
    return _robotID + "." + position.port;
}

std::string LoadDevice::GetStation(const VDA5050::Action& action) const
{
    std::string named = GetText(action, KEY_STATION);
    return named.empty() && _stationIDs.size() == 1 ? _stationIDs.front() : named;
}

std::string LoadDevice::Move(std::string carrierID, std::string from, std::string to)
{
    if (from.empty() || to.empty())
    {
        return std::string(NO_STATION);
    }
    const Core::Result<void> moved =
        _worldOrNull->Act(Sim::CarrierMoved{_robotID, std::move(carrierID), std::move(from), std::move(to)});
    return moved.has_value() ? std::string() : Core::Describe(moved.error());
}

std::string LoadDevice::ReadWorld()
{
    UpdateLoads();
    const std::optional<Core::Error> failed = _worldOrNull == nullptr ? std::nullopt : _worldOrNull->GetFailureOrNull();
    return failed.has_value() ? Core::Describe(*failed) : std::string();
}

std::string LoadDevice::PickUp(const VDA5050::Action& action)
{
    std::string unreadable = ReadWorld();
    if (!unreadable.empty())
    {
        return unreadable;
    }
    VDA5050::Load load = MakeLoad(action);
    if (std::max(load.loadID->size(), load.loadType.size()) > MAX_ID_LENGTH)
    {
        return "the load's id or type is too long";
    }
    if (!load.loadID->empty() && std::ranges::find(_loads, load.loadID, &VDA5050::Load::loadID) != _loads.end())
    {
        return "this load is already on board";
    }
    // The named position, else the first free one.
    const auto place = std::ranges::find_if(_positions, [&](const LoadPosition& position) {
        return load.loadPosition.empty() ? IsFree(position.name) : position.name == load.loadPosition;
    });
    if (place == _positions.end())
    {
        return load.loadPosition.empty() ? "no free load position" : "no such load position";
    }
    if (!IsFree(place->name))
    {
        return "this load position is occupied";
    }
    if (_worldOrNull != nullptr)
    {
        std::string failure = Move(*load.loadID, GetStation(action), GetPort(*place));
        if (!failure.empty())
        {
            return failure;
        }
        load.loadID = _worldOrNull->GetCarrierOrNull(GetPort(*place)).value_or("");
    }
    load.loadPosition = place->name;
    _loads.push_back(std::move(load));
    UpdateLoads();
    return {};
}

std::string LoadDevice::PutDown(const VDA5050::Action& action)
{
    std::string unreadable = ReadWorld();
    if (!unreadable.empty())
    {
        return unreadable;
    }
    // The named load, else the one in the named position, else the last one.
    const VDA5050::Load wanted = MakeLoad(action);
    auto found = std::ranges::find_if(_loads, [&wanted](const VDA5050::Load& load) {
        return !wanted.loadID->empty() ? load.loadID == wanted.loadID : load.loadPosition == wanted.loadPosition;
    });
    if (found == _loads.end() && wanted.loadID->empty() && wanted.loadPosition.empty() && !_loads.empty())
    {
        found = std::prev(_loads.end());
    }
    if (found == _loads.end())
    {
        return "this load is not on board";
    }
    if (!wanted.loadPosition.empty() && found->loadPosition != wanted.loadPosition)
    {
        return "this load is in another load position";
    }
    if (_worldOrNull != nullptr)
    {
        const auto place = std::ranges::find(_positions, found->loadPosition, &LoadPosition::name);
        std::string failure = Move(found->loadID.value_or(""), GetPort(*place), GetStation(action));
        if (!failure.empty())
        {
            return failure;
        }
    }
    _loads.erase(found);
    return {};
}

Core::Result<void> LoadDevice::Dock(std::vector<std::string> stationIDs)
{
    _stationIDs = std::move(stationIDs);
    return _worldOrNull == nullptr ? Core::Result<void>() : _worldOrNull->Act(Sim::RobotDocked{_robotID, _stationIDs});
}

void LoadDevice::UpdateLoads()
{
    if (_worldOrNull == nullptr)
    {
        return;
    }
    std::vector<VDA5050::Load> loads;
    for (const LoadPosition& position : _positions)
    {
        const std::optional<std::string> carrier = _worldOrNull->GetCarrierOrNull(GetPort(position));
        if (!carrier.has_value())
        {
            continue;
        }
        const auto known = std::ranges::find(_loads, carrier, &VDA5050::Load::loadID);
        VDA5050::Load load;
        load.loadID = *carrier;
        load.loadType = known != _loads.end() ? known->loadType : std::string();
        load.loadPosition = position.name;
        loads.push_back(std::move(load));
    }
    _loads = std::move(loads);
}

const std::vector<VDA5050::Load>& LoadDevice::GetLoads() const noexcept
{
    return _loads;
}

} // namespace ACS::VdaSim
