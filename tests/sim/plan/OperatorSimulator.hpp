#pragma once

#include "AcsdProcess.hpp"
#include "ChanceModel.hpp"
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
class OperatorSimulator final
{
public:
    using Robots = std::map<std::string, std::unique_ptr<ISimulatedRobot>>;
    /// The acsd that runs, or null.
    using ProcessSource = std::function<AcsdProcess*()>;

private:
    enum class EBehaviour : std::uint8_t
    {
        Turn,
        Look,
    };
    struct Service
    {
        bool bInMaintenance = false;
        std::size_t looks = 0; ///< Since it was last another one, or the disk failed.
    };

    Trace& _trace;
    ChanceModel _dice;
    const Robots& _robots;
    const CrashableStore& _store;
    ProcessSource _getProcessOrNull;
    TimerBank<EBehaviour> _habits;

    std::map<std::string, std::string> _resting; ///< NodeIDs of those that stand out of service.
    std::map<std::string, Service> _services;    ///< As acsd shows them.
    std::map<std::string, bool> _expected;       ///< After a start: whether it is in maintenance.

public:
    OperatorSimulator(
        Timeline& timeline,
        Trace& trace,
        const ChanceSeed& seed,
        const Robots& robots,
        const CrashableStore& store,
        ProcessSource getProcessOrNull);

    void Begin();
    void End();
    /// Acsd was started. A plan whose end it had not written down is its robot's again; maintenance is as it was.
    void OnStart();
    /// Until all are in service.
    void GiveBack() const;

private:
    void Turn();
    void Look();
    void LookAtRest(const Planning::RobotStatus& robot);
    void LookAtService(const Planning::RobotStatus& robot);
};

} // namespace ACS::Simulation
