#include "PauseControl.hpp"

#include <utility>

namespace ACS::VDA5050
{

void PauseControl::Start(std::string actionID)
{
    _startActionIDs.push_back(std::move(actionID));
    _bByMaster = true;
}

std::vector<std::string> PauseControl::Stop()
{
    _bByMaster = false;
    _bBySwitch = false;
    return TakeFinished();
}

void PauseControl::SetSwitch(bool bPaused, bool bOverridesMaster)
{
    _bBySwitch = bPaused;
    _bOverridden = bOverridesMaster;
}

std::vector<std::string> PauseControl::TakeFinished()
{
    return std::exchange(_startActionIDs, {});
}

bool PauseControl::IsPaused() const noexcept
{
    return _bByMaster || _bBySwitch;
}

bool PauseControl::IsOverridden() const noexcept
{
    return _bOverridden;
}

} // namespace ACS::VDA5050
