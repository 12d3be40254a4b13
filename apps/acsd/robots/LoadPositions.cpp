#include "robots/LoadPositions.hpp"

#include <algorithm>

namespace ACS::Acsd
{

LoadPositions::LoadPositions(
    const std::vector<Core::Location>& ports,
    const std::map<std::string, std::string, std::less<>>& names)
{
    for (const Core::Location& port : ports)
    {
        const std::string name = GetPortName(port);
        const auto given = names.find(name);
        _ports.push_back({port.GetText(), given == names.end() ? name : given->second});
    }
}

std::string LoadPositions::GetPortName(const Core::Location& port)
{
    return port.GetText().substr(port.GetText().find('.') + 1);
}

const std::string* LoadPositions::FindPositionOrNull(std::string_view location) const
{
    const auto port = std::ranges::find(_ports, location, &Port::location);
    return port == _ports.end() ? nullptr : &port->position;
}

const std::string* LoadPositions::FindPortOrNull(std::string_view position) const
{
    const auto port = std::ranges::find(_ports, position, &Port::position);
    if (port != _ports.end())
    {
        return &port->location;
    }
    return position.empty() && _ports.size() == 1 ? &_ports.front().location : nullptr;
}

bool LoadPositions::IsEmpty() const noexcept
{
    return _ports.empty();
}

std::optional<std::vector<Planning::PortLoad>> LoadPositions::MakePortLoadsOrNull(
    const VDA5050::StateMessage& state) const
{
    if (!state.loads.has_value() || _ports.empty())
    {
        return std::nullopt;
    }
    std::vector<Planning::PortLoad> loads;
    for (const Port& port : _ports)
    {
        loads.push_back({port.location, false, {}});
    }
    for (const VDA5050::Load& load : *state.loads)
    {
        const std::string* const port = FindPortOrNull(load.loadPosition);
        if (port == nullptr)
        {
            return std::nullopt; // it may be on any port; VehicleWatch reports it
        }
        Planning::PortLoad& shown = *std::ranges::find(loads, *port, &Planning::PortLoad::port);
        shown.bLoaded = true;
        shown.carrierID = shown.carrierID.empty() ? load.loadID.value_or(std::string()) : shown.carrierID;
    }
    return loads;
}

} // namespace ACS::Acsd
