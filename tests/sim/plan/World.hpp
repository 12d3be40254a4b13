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
#include "Scenario.hpp"
#include "TextNetwork.hpp"
#include "TimerBank.hpp"
#include "Trace.hpp"
#include "WorkChecker.hpp"

#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Simulation
{

/// One seed's world, from its first plan until everything has come to its end.
class World final
{
    enum class EBehaviour : std::uint8_t
    {
        Restart,
        Disk,
        Link,
        Crash,
        Operator,
        Broker,
        EndFaults,
        Watch,
    };

    Scenario _scenario;
    EMutation _mutation;
    Timeline _timeline;
    Trace _trace;
    ChanceModel _dice;        ///< Of acsd's surroundings.
    ChanceModel _ownRandom;   ///< Of acsd's ids.
    ChanceModel _weather;     ///< Of what breaks from outside.
    ChanceModel _robotChance; ///< Of what happens to robots.
    CrashableStore _store;
    Planning::SiteMap _site;
    WorkChecker _witness;
    McsJudge _judge;
    TextNetwork _network;
    McsSide _mcs;
    MqttBroker _broker;
    std::map<std::string, std::unique_ptr<ISimulatedRobot>> _robots;
    TimerBank<EBehaviour> _habits;
    TimerBank<std::string> _robotBehaviours;
    TimerBank<std::string> _radioBehaviours;
    std::unique_ptr<AcsdProcess> _process;
    OperatorSimulator _caretaker;
    std::uint64_t _starts = 0;
    Core::SteadyTime _deadline{};
    bool _bSettling = false;
    bool _bDone = false;

public:
    World(Scenario scenario, EMutation mutation, bool bPrinting);

    /// The rules that were broken, the first one first; empty where none was.
    [[nodiscard]] std::vector<std::string> Run();

    [[nodiscard]] std::size_t GetStarts() const noexcept;
    [[nodiscard]] Core::Duration GetAge() const;

private:
    void AddRobots();
    void StartAcsd();
    void BringIntoReach();
    void OnCrash();
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
    void Watch();
    void TakeCarriersOff();
    [[nodiscard]] std::vector<std::string> GetPorts(std::string_view robotID) const;
    [[nodiscard]] std::string DescribeUnrest() const;
};

} // namespace ACS::Simulation
