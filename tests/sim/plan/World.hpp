#pragma once

#include "AcsdProcess.hpp"
#include "ChanceModel.hpp"
#include "CrashableStore.hpp"
#include "EMutation.hpp"
#include "ISimulatedRobot.hpp"
#include "McsJudge.hpp"
#include "McsSide.hpp"
#include "MqttBroker.hpp"
#include "OperatorSimulator.hpp"
#include "replay/CoreRecorder.hpp"
#include "Scenario.hpp"
#include "TextNetwork.hpp"
#include "TimerBank.hpp"
#include "Trace.hpp"
#include "WorkChecker.hpp"

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Simulation
{

/// The run of one seed, from its first plan until all work is finished.
class World final
{
public:
    /// Called at each start of acsd, with its number. Returns what receives the records of this start.
    using RecordingHandler = std::function<Acsd::CoreRecorder::RecordHandler(std::uint64_t start)>;

private:
    enum class EBehaviour : std::uint8_t
    {
        Restart,
        Disk,
        Link,
        Crash,
        Operator,
        Broker,
        Partition,
        Stop,
        EndFaults,
        Watch,
    };

    Scenario _scenario;
    EMutation _mutation;
    Timeline _timeline;
    Trace _trace;
    ChanceModel _chance;      ///< For what surrounds acsd.
    ChanceModel _ownRandom;   ///< For acsd's ids.
    ChanceModel _faultChance; ///< For faults from outside.
    ChanceModel _robotChance; ///< For events of robots.
    ChanceModel _leaseChance; ///< For latencies of the lease.
    CrashableStore _store;
    Planning::SiteMap _site;
    WorkChecker _workChecker;
    McsJudge _judge;
    TextNetwork _network;
    McsSide _mcs;
    MqttBroker _broker;
    std::map<std::string, std::unique_ptr<ISimulatedRobot>> _robots;
    TimerBank<EBehaviour> _behaviours;
    TimerBank<std::string> _robotBehaviours;
    TimerBank<std::string> _radioBehaviours;
    std::unique_ptr<AcsdProcess> _process;
    std::unique_ptr<AcsdProcess> _former;     ///< A leader that has not ended in time, by a mutation.
    std::unique_ptr<SimulatedLease> _standby; ///< Of a shared store.
    OperatorSimulator _operator;
    RecordingHandler _onRecording; ///< May be empty.
    std::uint64_t _starts = 0;
    Core::SteadyTime _deadline{};
    bool _bSettling = false;
    bool _bDone = false;

public:
    World(Scenario scenario, EMutation mutation, bool bPrinting, RecordingHandler onRecording = {});

    /// The rules that were violated in their order; empty: none.
    [[nodiscard]] std::vector<std::string> Run();

    [[nodiscard]] std::size_t GetStarts() const noexcept;
    [[nodiscard]] Core::Duration GetAge() const;

private:
    void AddRobots();
    /// With the lease of a shared store.
    void StartAcsd(std::uint64_t epoch, std::unique_ptr<SimulatedLease> leaseOrNull);
    void BringIntoReach();
    void OnCrash(std::uint64_t number);
    void BeStandby();
    void CutOffSometime();
    void StopSometime();
    void BeginFaults();
    void EndFaults();
    void TurnDisk();
    void TurnLink();
    void Operate();
    void CrashSometime();
    void TurnBroker();
    void TurnRobot(const std::string& robotID);
    void TurnRadio(const std::string& robotID);
    void ResolveJobs();
    void ClearRejections();
    void Watch();
    void RemoveCarriers();
    [[nodiscard]] std::vector<std::string> GetPorts(std::string_view robotID) const;
    [[nodiscard]] std::string DescribeUnrest() const;
};

} // namespace ACS::Simulation
