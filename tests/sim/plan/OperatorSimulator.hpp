#pragma once

#include "AcsdProcess.hpp"
#include "ChanceModel.hpp"
#include "ISimulatedRobot.hpp"
#include "McsJudge.hpp"
#include "TimerBank.hpp"
#include "Trace.hpp"

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>

namespace ACS::Simulation
{

/// The operator who takes robots out of service and puts them back, and checks that acsd leaves a robot alone that
/// is stationary and out of service. In some runs the operator also controls plans,
/// changes their priorities and blocks parts of the map; no node is granted that is blocked.
class OperatorSimulator final
{
public:
    using Robots = std::map<std::string, std::unique_ptr<ISimulatedRobot>>;
    /// The running acsd, or null.
    using ProcessSource = std::function<AcsdProcess*()>;

private:
    enum class EBehaviour : std::uint8_t
    {
        Turn,
        Poll,
        Intervene,
        CheckBlocks,
    };
    struct Service
    {
        bool bInMaintenance = false;
        std::size_t polls = 0; ///< Since the last change or disk failure.
    };

    Trace& _trace;
    ChanceModel _chance;
    const Robots& _robots;
    const CrashableStore& _store;
    McsJudge& _judge;
    ProcessSource _getProcessOrNull;
    TimerBank<EBehaviour> _behaviours;

    std::map<std::string, std::string> _resting;           ///< NodeIDs of those that are stationary and out of service.
    std::map<std::string, Service> _services;              ///< As acsd reports them.
    std::map<std::string, std::set<std::string>> _granted; ///< Of blocked nodes: robots that had them before.
    std::map<std::string, bool> _expected;                 ///< After a start: whether it is in maintenance.

public:
    OperatorSimulator(
        Timeline& timeline,
        Trace& trace,
        const ChanceSeed& seed,
        const Robots& robots,
        const CrashableStore& store,
        McsJudge& judge,
        ProcessSource getProcessOrNull);

    void Begin();
    /// Controls plans from now on.
    void BeginInterventions();
    void End();
    /// acsd was started. A robot has its plan again if the end was not stored; maintenance is as before.
    void OnStart();
    /// Puts all robots back into service.
    void PutAllIntoService() const;
    /// Removes all blocks.
    void RemoveBlocks() const;

private:
    void Turn();
    void Poll();
    void Intervene();
    void ControlPlan(AcsdProcess& process);
    void ChangePriority(AcsdProcess& process);
    void ChangeBlocks(AcsdProcess& process);
    void CheckBlocks();
    void CheckResting(const Planning::RobotStatus& robot);
    void CheckService(const Planning::RobotStatus& robot);
};

} // namespace ACS::Simulation
