#pragma once

#include "AnswerChecker.hpp"
#include "DriveChecker.hpp"
#include "JobChecker.hpp"
#include "StateChecker.hpp"
#include "VirtualTime.hpp"
#include <acs/adapter_test/ContractReport.hpp>
#include <acs/adapter_test/IAdapterBench.hpp>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <string>
#include <vector>

namespace ACS::AdapterTest
{

/// One scenario: a new robot with an adapter, commanded in virtual time. Carries out what the adapter requests, as acsd
/// does, and has every event checked.
class ScenarioRun final
{
public:
    using Condition = std::function<bool()>;

private:
    /// Of one adapter. It outlives the adapter, so that a late call is detected.
    class Host final : public IAdapterHost
    {
        ScenarioRun& _run;

    public:
        explicit Host(ScenarioRun& run);
        void Call(const AdapterCall& adapterCall) override;
    };

    IAdapterBench& _bench;
    const BenchOptions& _options;
    ContractReport& _report;
    const std::string _name;
    VirtualTime _time;
    StateChecker _states;
    DriveChecker _drives;
    JobChecker _jobs;
    std::list<Host> _hosts;
    Planning::IRobotAdapter* _adapterOrNull = nullptr;
    std::map<Planning::AdapterTimerID, VirtualTime::Ticket> _timers;
    std::deque<Planning::AdapterAction> _actions; ///< To be carried out.
    bool _bExecuting = false;
    std::list<Planning::AdapterActions>
        _outs; ///< Of all calls: emptied after the call, and not changed by the adapter later.
    std::vector<Core::SteadyTime> _callTimes; ///< When the adapter was called.
    bool _bLinkUp = true;
    std::uint32_t _lastNumber = 0;     ///< Of the IDs that were made.
    std::vector<std::string> _sentIDs; ///< Of drives and jobs, in order.
    AnswerChecker _answers;

public:
    /// Makes the robot and its adapter.
    ScenarioRun(IAdapterBench& bench, const BenchOptions& options, ContractReport& report, std::string name);
    ScenarioRun(const ScenarioRun&) = delete;
    ScenarioRun& operator=(const ScenarioRun&) = delete;
    /// Destroys both, with the last checks.
    ~ScenarioRun();

    void AddFinding(ERule rule, std::string happened);
    void Command(const Planning::RobotCommand& command);
    void SetConduct(EConduct conduct);
    void SetLink(bool bUp);
    void Crash();
    void Restart();

    void PassTime(Core::Duration span);
    /// Until the condition holds. False: it does not hold within the limit.
    [[nodiscard]] bool TryAwait(const Condition& condition, Core::Duration limit);
    /// Until the robot is connected and has reported its state; otherwise adds a finding.
    [[nodiscard]] bool TryConnect();

    [[nodiscard]] Planning::Drive MakeDrive(std::size_t releasedCount);
    /// The job of this number on the robot's node, under a new commandID.
    [[nodiscard]] Planning::StartJob MakeJob(std::size_t number);
    /// With the IDs of what was commanded before the job.
    [[nodiscard]] Planning::RecoverJob MakeRecovery(const Planning::StartJob& job) const;
    [[nodiscard]] std::string MakeID();

    [[nodiscard]] const BenchOptions& GetOptions() const noexcept;
    [[nodiscard]] StateChecker& GetStates() noexcept;
    [[nodiscard]] const DriveChecker& GetDrives() const noexcept;
    [[nodiscard]] const JobChecker& GetJobs() const noexcept;
    [[nodiscard]] RobotTruth GetTruth() const;
    [[nodiscard]] Core::SteadyTime GetTime() const;
    /// When the adapter was called after this time: something has happened then.
    [[nodiscard]] std::vector<Core::SteadyTime> ListCallTimes(Core::SteadyTime after) const;

private:
    void MakeAdapter();
    void Call(const Host& host, const IAdapterHost::AdapterCall& adapterCall);
    void CallAdapter(const IAdapterHost::AdapterCall& adapterCall);
    void ExecuteAll();
    void Execute(const Planning::AdapterAction& action);
    void StartTimer(const Planning::StartAdapterTimer& start);
    void OnEvent(const Planning::RobotEvent& event);
    void Sample();
    void VerifyOuts();
};

} // namespace ACS::AdapterTest
