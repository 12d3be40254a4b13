#pragma once

#include <string>
#include <vector>

namespace ACS::VDA5050
{

/// Who pauses a vehicle, master control or its own switch, and the startPause actions that wait until it is stationary.
class PauseControl
{
    bool _bByMaster = false;
    bool _bBySwitch = false;
    bool _bOverridden = false; ///< The switch alone decides.
    std::vector<std::string> _startActionIDs;

public:
    void Start(std::string actionID);
    /// Ends a pause of either origin. Returns the startPause actions that have not finished.
    [[nodiscard]] std::vector<std::string> Stop();
    void SetSwitch(bool bPaused, bool bOverridesMaster);
    /// The vehicle is stationary. Returns the startPause actions that finish with it.
    [[nodiscard]] std::vector<std::string> TakeFinished();

    [[nodiscard]] bool IsPaused() const noexcept;
    [[nodiscard]] bool IsOverridden() const noexcept;
};

} // namespace ACS::VDA5050
