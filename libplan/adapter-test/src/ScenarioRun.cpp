#include "ScenarioRun.hpp"

#include <acs/core/Overloaded.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <utility>
#include <variant>

namespace ACS::AdapterTest
{

ScenarioRun::Host::Host(ScenarioRun& run)
    : _run(run)
{
}

void ScenarioRun::Host::Call(const AdapterCall& adapterCall)
{
    _run.Call(*this, adapterCall);
}

ScenarioRun::ScenarioRun(IAdapterBench& bench, const BenchOptions& options, ContractReport& report, std::string name)
    : _bench(bench),
      _options(options),
      _report(report),
      _name(std::move(name)),
      _states([this](ERule rule, std::string happened) { AddFinding(rule, std::move(happened)); }),
      _drives([this](ERule rule, std::string happened) { AddFinding(rule, std::move(happened)); }),
      _jobs([this](ERule rule, std::string happened) { AddFinding(rule, std::move(happened)); }),
      _answers([this](ERule rule, std::string happened) { AddFinding(rule, std::move(happened)); }, bench.MakeJob(0))
{
    _report.scenarios.push_back(_name);
    _bench.MakeRobot(_time);
    MakeAdapter();
    Sample();
}

ScenarioRun::~ScenarioRun()
{
    Crash();
    PassTime(_options.answerLimit / 4); // nothing may be raised now
    if (_time.IsExhausted())
    {
        AddFinding(ERule::TimeAdvances, "too many tasks and timers were started.");
    }
    VerifyOuts();
    _bench.DestroyRobot();
}

void ScenarioRun::AddFinding(ERule rule, std::string happened)
{
    const bool bKnown = std::ranges::any_of(_report.findings, [this, rule](const Finding& finding) {
        return finding.rule == rule && finding.scenario == _name;
    });
    if (!bKnown)
    {
        _report.findings.push_back({rule, _name, _time.GetAge(), std::move(happened)});
    }
}

void ScenarioRun::Command(const Planning::RobotCommand& command)
{
    const RobotTruth truth = GetTruth();
    _states.OnCommand(command);
    std::visit(
        Core::Overloaded{
            [this, &truth](const Planning::Drive& drive) {
                _sentIDs.push_back(drive.driveID);
                _drives.OnDrive(drive, truth);
            },
            [this](const Planning::ExtendDrive& extend) { _drives.OnExtend(extend); },
            [this](const Planning::CancelDrive& cancel) { _drives.OnCancel(cancel); },
            [this, &truth](const Planning::StartJob& job) {
                _sentIDs.push_back(job.commandID);
                _jobs.OnStart(job, truth);
            },
            [this, &truth](const Planning::RecoverJob& recover) { _jobs.OnRecover(recover, truth); },
            [](const auto& /*other*/) {
            }},
        command);
    CallAdapter(
        [this, &command](Core::Now now, Planning::AdapterActions& out) { _adapterOrNull->Handle(command, now, out); });
}

void ScenarioRun::SetConduct(EConduct conduct)
{
    _states.OnConduct(conduct);
    _bench.SetConduct(conduct);
}

void ScenarioRun::SetLink(bool bUp)
{
    if (std::exchange(_bLinkUp, bUp) != bUp)
    {
        _bench.SetLink(bUp);
    }
}

void ScenarioRun::Crash()
{
    if (_adapterOrNull == nullptr)
    {
        return;
    }
    _answers.Verify(*_adapterOrNull);
    _adapterOrNull = nullptr;
    _bench.DestroyAdapter();
    for (const auto& [timer, ticket] : std::exchange(_timers, {}))
    {
        _time.Withdraw(ticket);
    }
    _actions.clear();
    _states.OnRestart();
    _drives.OnRestart();
}

void ScenarioRun::Restart()
{
    MakeAdapter();
}

void ScenarioRun::PassTime(Core::Duration span)
{
    static_cast<void>(TryAwait([] { return false; }, span));
}

bool ScenarioRun::TryAwait(const Condition& condition, Core::Duration limit)
{
    const Core::SteadyTime until = _time.GetNow().steady + limit;
    bool bStepped = true;
    while (bStepped && !condition())
    {
        bStepped = _time.TryStep(until);
        Sample();
    }
    return condition();
}

bool ScenarioRun::TryConnect()
{
    if (!TryAwait([this] { return _states.IsOnline(); }, _options.answerLimit))
    {
        AddFinding(ERule::LinkReported, "the robot is connected, and no LinkChanged to online was raised.");
        return false;
    }
    if (!TryAwait([this] { return _states.GetStateOrNull() != nullptr; }, _options.answerLimit))
    {
        AddFinding(ERule::StateAfterConnection, "LinkChanged to online was raised, and no StateChanged after it.");
        return false;
    }
    return true;
}

Planning::Drive ScenarioRun::MakeDrive(std::size_t releasedCount)
{
    Planning::Drive drive;
    drive.driveID = MakeID();
    drive.route = _options.route;
    // The route begins at the robot's node.
    const std::string nodeID = GetTruth().nodeID;
    const auto start = std::ranges::find(drive.route.nodes, nodeID, &Planning::RouteNode::nodeID);
    const auto skipped = start == drive.route.nodes.end() ? 0 : start - drive.route.nodes.begin();
    drive.route.nodes.erase(drive.route.nodes.begin(), drive.route.nodes.begin() + skipped);
    drive.route.edges.erase(drive.route.edges.begin(), drive.route.edges.begin() + skipped);
    drive.releasedCount = std::min(releasedCount, drive.route.nodes.size());
    return drive;
}

Planning::StartJob ScenarioRun::MakeJob(std::size_t number)
{
    Planning::StartJob job = _bench.MakeJob(number);
    job.planID = "plan-1";
    job.stepNo = 1;
    job.jobID = fmt::format("job-{}", number + 1);
    job.commandID = MakeID();
    job.jobNumber = static_cast<std::int32_t>(1'000 + _lastNumber);
    job.nodeID = GetTruth().nodeID;
    const Planning::StateChanged* const stateOrNull = _states.GetStateOrNull();
    job.progressToken = stateOrNull == nullptr ? std::string() : stateOrNull->restartEvidence.progressToken;
    return job;
}

Planning::RecoverJob ScenarioRun::MakeRecovery(const Planning::StartJob& job) const
{
    Planning::RecoverJob recover{job, {_sentIDs.begin(), std::ranges::find(_sentIDs, job.commandID)}};
    std::ranges::reverse(recover.earlierIDs);
    return recover;
}

std::string ScenarioRun::MakeID()
{
    return fmt::format("00000000-0000-4000-8000-{:012}", ++_lastNumber);
}

const BenchOptions& ScenarioRun::GetOptions() const noexcept
{
    return _options;
}

StateChecker& ScenarioRun::GetStates() noexcept
{
    return _states;
}

const DriveChecker& ScenarioRun::GetDrives() const noexcept
{
    return _drives;
}

const JobChecker& ScenarioRun::GetJobs() const noexcept
{
    return _jobs;
}

RobotTruth ScenarioRun::GetTruth() const
{
    return _bench.GetTruth();
}

Core::SteadyTime ScenarioRun::GetTime() const
{
    return _time.GetNow().steady;
}

std::vector<Core::SteadyTime> ScenarioRun::ListCallTimes(Core::SteadyTime after) const
{
    return {std::ranges::upper_bound(_callTimes, after), _callTimes.end()};
}

void ScenarioRun::MakeAdapter()
{
    _adapterOrNull = &_bench.MakeAdapter(_hosts.emplace_back(*this));
    _answers.OnAdapter(*_adapterOrNull);
}

void ScenarioRun::Call(const Host& host, const IAdapterHost::AdapterCall& adapterCall)
{
    if (_adapterOrNull == nullptr || &host != &_hosts.back())
    {
        AddFinding(ERule::SilentAfterDestruction, "the adapter was called, or has called, after its destruction.");
        return;
    }
    CallAdapter(adapterCall);
}

void ScenarioRun::CallAdapter(const IAdapterHost::AdapterCall& adapterCall)
{
    if (_callTimes.empty() || _callTimes.back() != _time.GetNow().steady)
    {
        _callTimes.push_back(_time.GetNow().steady);
    }
    Planning::AdapterActions& out = _outs.emplace_back();
    adapterCall(_time.GetNow(), out);
    std::ranges::move(out, std::back_inserter(_actions));
    out.clear();
    if (!std::exchange(_bExecuting, true))
    {
        ExecuteAll();
    }
}

void ScenarioRun::ExecuteAll()
{
    while (!_actions.empty())
    {
        const Planning::AdapterAction action = std::move(_actions.front());
        _actions.pop_front();
        Execute(action);
    }
    _bExecuting = false;
    _bench.OnAdapterCalled();
    Sample();
}

void ScenarioRun::Execute(const Planning::AdapterAction& action)
{
    std::visit(
        Core::Overloaded{
            [this](const Planning::RaiseEvent& raise) { OnEvent(raise.event); },
            [this](const Planning::StartAdapterTimer& start) { StartTimer(start); },
            [this](const Planning::CancelAdapterTimer& cancel) {
                if (const auto found = _timers.find(cancel.timer); found != _timers.end())
                {
                    _time.Withdraw(found->second);
                    _timers.erase(found);
                }
            }},
        action);
}

void ScenarioRun::StartTimer(const Planning::StartAdapterTimer& start)
{
    const Planning::AdapterTimerID timer = start.timer;
    if (const auto found = _timers.find(timer); found != _timers.end())
    {
        _time.Withdraw(found->second);
    }
    _timers[timer] = _time.PostTask(start.delay, [this, timer] {
        _timers.erase(timer);
        CallAdapter(
            [this, timer](Core::Now now, Planning::AdapterActions& out) { _adapterOrNull->OnTimer(timer, now, out); });
    });
}

void ScenarioRun::OnEvent(const Planning::RobotEvent& event)
{
    const RobotTruth truth = GetTruth();
    Sample();
    std::visit(
        Core::Overloaded{
            [this](const Planning::LinkChanged& link) { _states.OnLink(link); },
            [this, &truth](const Planning::StateChanged& state) { _states.OnState(state, truth); },
            [this](const Planning::NodePassed& passed) { _drives.OnNodePassed(passed); },
            [this, &truth](const Planning::Arrived& arrived) { _drives.OnArrived(arrived, truth); },
            [this, &truth](const Planning::DriveRejected& rejected) { _drives.OnRejected(rejected, truth); },
            [this, &truth](const Planning::DriveCancelled& cancelled) { _drives.OnCancelled(cancelled, truth); },
            [this](const Planning::JobStarted& job) { _jobs.OnStarted(job); },
            [this, &truth](const Planning::JobFinished& job) {
                _states.OnJobFinished(truth);
                _jobs.OnFinished(job, truth);
            },
            [this, &truth](const Planning::JobFailed& job) { _jobs.OnFailed(job, truth); },
            [this, &truth](const Planning::JobRejected& job) { _jobs.OnRejected(job, truth); },
            [this, &truth](const Planning::JobInterrupted& job) { _jobs.OnInterrupted(job, truth); },
            [this, &truth](const Planning::JobUnknown& job) { _jobs.OnUnknown(job, truth); },
            [this](const Planning::JobUnresolved& job) { _jobs.OnUnresolved(job); },
            [this](const Planning::JobCheckChanged& changed) { _answers.OnJobCheck(changed.jobCheck); },
            [this](const Planning::CompatibilityChanged& changed) {
                _states.OnCompatibility(changed);
            }},
        event);
}

void ScenarioRun::Sample()
{
    const RobotTruth truth = GetTruth();
    _drives.Sample(truth, _states.GetStateOrNull());
    _jobs.Sample(truth);
}

void ScenarioRun::VerifyOuts()
{
    if (std::ranges::any_of(_outs, [](const Planning::AdapterActions& out) { return !out.empty(); }))
    {
        AddFinding(ERule::OutputInCall, "the adapter has appended to the output of an earlier call.");
    }
}

} // namespace ACS::AdapterTest
