#pragma once

#include "AcsdProcess.hpp"
#include "Dice.hpp"
#include "ISimulatedRobot.hpp"
#include "TimerBank.hpp"
#include "Trace.hpp"

#include <functional>
#include <map>
#include <memory>
#include <string>

namespace ACS::Simulation
{

/// The operator who takes robots out of service and gives them back; and who sees that one that stands out of service is
/// left alone.
class Caretaker final
{
public:
    using Robots = std::map<std::string, std::unique_ptr<ISimulatedRobot>>;
    /// The acsd that runs, or null.
    using ProcessSource = std::function<AcsdProcess*()>;

private:
    enum class EHabit : std::uint8_t
    {
        Turn,
        Look,
    };

    Trace& _trace;
    Dice _dice;
    const Robots& _robots;
    ProcessSource _getProcessOrNull;
    TimerBank<EHabit> _habits;
    std::map<std::string, std::string> _resting; ///< NodeIDs of those that stand out of service.

    void Turn();
    void Look();

public:
    Caretaker(
        Timeline& timeline,
        Trace& trace,
        const DiceSeed& seed,
        const Robots& robots,
        ProcessSource getProcessOrNull);

    void Begin();
    void End();
    /// Acsd was started. A plan whose end it had not written down is its robot's again.
    void OnStart();
    /// Until all are in service.
    void GiveBack() const;
};

} // namespace ACS::Simulation
