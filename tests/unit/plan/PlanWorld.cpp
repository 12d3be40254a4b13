#include "PlanWorld.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <set>

namespace ACS::Testing
{

using namespace Planning; // NOLINT(google-build-using-namespace): a test of that namespace

namespace
{

constexpr std::chrono::hours TIME_LIMIT{24 * 7};

std::string DescribeReport(const Report& report)
{
    return std::visit(
        Core::Overloaded{
            [](const PlanReport& typed) { return fmt::format("{} Plan {}", typed.planID, GetText(typed.state)); },
            [](const StepReport& typed) {
                return fmt::format("{} Step {} {}", typed.planID, typed.stepNo, GetText(typed.state));
            },
            [](const JobReport& typed) {
                return fmt::format("{} Job {} {} {}", typed.planID, typed.stepNo, typed.jobID, GetText(typed.state));
            },
            [](const ErrorReport& typed) {
                return fmt::format(
                    "{} Error {} {}",
                    typed.alarm.planID.value_or("-"),
                    typed.alarm.errorCode,
                    typed.bSet ? "set" : "cleared");
            },
            [](const ControlResultReport& typed) {
                return fmt::format(
                    "{} {}Result {}",
                    typed.planID,
                    GetText(typed.control),
                    typed.bSucceeded ? "Success" : "Failed");
            }},
        report);
}

std::string DescribeCommand(const RobotCommand& command)
{
    return std::visit(
        Core::Overloaded{
            [](const Drive& typed) {
                return fmt::format(
                    "Drive to {} released {} of {}",
                    typed.route.nodes.back().nodeID,
                    typed.releasedCount,
                    typed.route.nodes.size());
            },
            [](const ExtendDrive& typed) { return fmt::format("ExtendDrive {}", typed.releasedCount); },
            [](const CancelDrive&) { return std::string("CancelDrive"); },
            [](const StartJob& typed) {
                return fmt::format(
                    "StartJob {} {} {} {}>{} {}",
                    typed.jobID,
                    typed.action,
                    typed.position,
                    typed.from.value_or("-"),
                    typed.to.value_or("-"),
                    typed.carrierID.value_or("-"));
            },
            [](const RecoverJob& typed) { return fmt::format("RecoverJob {}", typed.job.jobID); },
            [](const CancelJob&) { return std::string("CancelJob"); },
            [](const Pause&) { return std::string("Pause"); },
            [](const Resume&) { return std::string("Resume"); },
            [](const StartCharging&) { return std::string("StartCharging"); },
            [](const StopCharging&) {
                return std::string("StopCharging");
            }},
        command);
}

} // namespace

PlanWorld::PlanWorld(std::uint64_t seed, bool bFourRobots)
    : PlanWorld(seed, MakeTestOptions(bFourRobots), MakeTestSite())
{
}

PlanWorld::PlanWorld(std::uint64_t seed, EngineOptions options, SiteMap site)
    : _random(seed)
{
    AddRobots(options);
    engine = std::make_unique<PlanEngine>(std::move(options), std::move(site), _random);
}

void PlanWorld::AddRobots(const EngineOptions& options)
{
    for (const RobotOptions& robot : options.robots)
    {
        _robots.emplace(
            robot.robotID.GetText(),
            std::make_unique<FakeRobotAdapter>(_random, robot.startNodeID.value_or("")));
    }
}

void PlanWorld::Connect()
{
    for (const auto& [robotID, robot] : _robots)
    {
        AdapterActions out;
        robot->Connect(out);
        ExecuteRobot(robotID, out);
    }
}

void PlanWorld::Submit(Plan plan, ReplyToken token, const std::string& transactionID)
{
    EngineActions out;
    engine->Handle(SubmitPlan{std::move(plan), token, transactionID}, GetNow(), out);
    Execute(std::move(out));
}

void PlanWorld::SubmitTogether(const std::vector<SubmitPlan>& plans)
{
    EngineActions out;
    engine->Submit(plans, GetNow(), out);
    Execute(std::move(out));
}

void PlanWorld::Control(
    EPlanControl control,
    const std::string& planID,
    ReplyToken token,
    const std::string& transactionID)
{
    EngineActions out;
    engine->Handle(ControlPlan{control, planID, "", token, transactionID}, GetNow(), out);
    Execute(std::move(out));
}

void PlanWorld::Settle(const std::string& planID, const std::string& jobID, EJobAnswer answer, ReplyToken token)
{
    EngineActions out;
    engine->Handle(SettleJob{planID, jobID, answer, token}, GetNow(), out);
    Execute(std::move(out));
}

void PlanWorld::Advance(std::chrono::milliseconds time)
{
    _clock.Advance(time);
}

void PlanWorld::SwitchTsc(bool bPause)
{
    EngineActions out;
    engine->Handle(ControlTsc{bPause, 0}, GetNow(), out);
    Execute(std::move(out));
}

void PlanWorld::Ask(const PlanCommand& command)
{
    EngineActions out;
    engine->Handle(command, GetNow(), out);
    Execute(std::move(out));
}

void PlanWorld::Raise(const std::string& robotID, const RobotEvent& event)
{
    if (engine == nullptr)
    {
        return;
    }
    EngineActions out;
    engine->Handle(robotID, event, GetNow(), out);
    Execute(std::move(out));
    CheckOccupancy();
}

void PlanWorld::TellState(const std::string& robotID)
{
    AdapterActions out;
    GetRobot(robotID).TellState(out);
    ExecuteRobot(robotID, out);
}

void PlanWorld::Operate(const std::string& robotID, const RobotCommand& command)
{
    AdapterActions out;
    GetRobot(robotID).Handle(command, GetNow(), out);
    ExecuteRobot(robotID, out);
}

void PlanWorld::Crash()
{
    std::erase_if(_entries, [](const Entry& entry) { return entry.robotID.empty(); });
    _delayed.clear();
    engine.reset();
    for (const auto& [robotID, robot] : _robots)
    {
        robot->LoseEngine();
    }
}

void PlanWorld::CrashAtAction(std::size_t number)
{
    _crashAt = number;
}

void PlanWorld::Restart(EngineOptions options, SiteMap site)
{
    Crash();
    _crashAt.reset();
    engine = std::make_unique<PlanEngine>(std::move(options), std::move(site), _random);
    EngineActions out;
    const StoredState state = *store.Load();
    engine->Restore(state, GetNow(), out);
    Replay(state.outbox);
    Execute(std::move(out));
    for (const OutboxEntry& entry : state.outbox)
    {
        if (bAcknowledges)
        {
            EngineActions acknowledged;
            engine->Handle(MessageAcknowledged{entry.sequence}, GetNow(), acknowledged);
            Execute(std::move(acknowledged));
        }
    }
}

/// What was stored and never sent; what was sent goes out once more and tells the MCS nothing new.
void PlanWorld::Replay(const std::vector<OutboxEntry>& outbox)
{
    for (const OutboxEntry& entry : outbox)
    {
        const bool bSent = std::ranges::count(reports, entry) > 0;
        if (!bSent)
        {
            trace.push_back("report " + DescribeReport(entry.report));
            reports.push_back(entry);
        }
    }
}

bool PlanWorld::TryRun(const std::function<bool()>& isReached)
{
    const Core::SteadyTime end = GetNow().steady + TIME_LIMIT;
    while (!_entries.empty())
    {
        if (isReached && isReached())
        {
            return true;
        }
        const auto next = std::ranges::min_element(_entries, {}, [](const Entry& entry) {
            return std::pair(entry.time, entry.order);
        });
        const Entry entry = *next;
        _entries.erase(next);
        if (entry.time > end)
        {
            return false;
        }
        _clock.Advance(std::chrono::duration_cast<std::chrono::milliseconds>(
            std::max(entry.time, GetNow().steady) - GetNow().steady));
        Fire(entry);
    }
    return !isReached || isReached();
}

void PlanWorld::Fire(const Entry& entry)
{
    if (entry.robotID.empty())
    {
        if (_engineTimers[entry.engineTimer] == entry.generation)
        {
            EngineActions out;
            engine->OnTimer(entry.engineTimer, GetNow(), out);
            Execute(std::move(out));
        }
    }
    else if (_robotTimers[{entry.robotID, entry.robotTimer}] == entry.generation)
    {
        AdapterActions out;
        GetRobot(entry.robotID).OnTimer(entry.robotTimer, GetNow(), out);
        ExecuteRobot(entry.robotID, out);
    }
    CheckOccupancy();
}

FakeRobotAdapter& PlanWorld::GetRobot(const std::string& robotID)
{
    return *_robots.at(robotID);
}

Core::Now PlanWorld::GetNow() const
{
    return _clock.GetNow();
}

std::uint64_t PlanWorld::GetRandom(std::uint64_t below)
{
    return _random.GetNext() % below;
}

std::vector<std::string> PlanWorld::GetReportsOf(const std::string& planID) const
{
    return GetTraceOf("report " + planID + " ");
}

std::vector<std::string> PlanWorld::GetTraceOf(const std::string& prefix) const
{
    std::vector<std::string> lines;
    for (const std::string& line : trace)
    {
        if (line.starts_with(prefix))
        {
            lines.push_back(line.substr(prefix.size()));
        }
    }
    return lines;
}

void PlanWorld::Push(Entry entry, Core::Duration delay)
{
    ++_order;
    entry.time = GetNow().steady + delay;
    entry.order = _order;
    entry.generation = _order;
    if (entry.robotID.empty())
    {
        _engineTimers[entry.engineTimer] = _order;
    }
    else
    {
        _robotTimers[{entry.robotID, entry.robotTimer}] = _order;
    }
    _entries.push_back(std::move(entry));
}

/// The actions, then what robots and the MCS say to them.
void PlanWorld::Execute(EngineActions actions)
{
    ExecuteAll(std::move(actions));
    RaiseDelayed();
}

void PlanWorld::ExecuteAll(EngineActions actions)
{
    std::vector<std::uint64_t> acknowledged;
    for (std::size_t i = 0; i < actions.size(); ++i)
    {
        if (engine == nullptr)
        {
            return;
        }
        if (_crashAt.has_value() && (*_crashAt)-- == 0)
        {
            _crashAt.reset();
            Crash();
            return;
        }
        const auto* storeOrNull = std::get_if<StorePlans>(&actions[i]);
        if (storeOrNull == nullptr)
        {
            ExecuteAction(actions[i], acknowledged);
            continue;
        }
        const Core::Result<void> stored = store.Append(storeOrNull->batch);
        trace.emplace_back(stored.has_value() ? "store" : "store failed");
        assert(i + 1 == actions.size() && "everything else is withheld");
        EngineActions released;
        engine->OnStored(stored, GetNow(), released);
        std::ranges::move(released, std::back_inserter(actions));
    }
    for (const std::uint64_t sequence : acknowledged)
    {
        if (engine == nullptr)
        {
            return;
        }
        EngineActions out;
        engine->Handle(MessageAcknowledged{sequence}, GetNow(), out);
        Execute(std::move(out));
    }
}

void PlanWorld::ExecuteAction(const EngineAction& action, std::vector<std::uint64_t>& acknowledged)
{
    std::visit(
        Core::Overloaded{
            [](const StorePlans&) {},
            [this](const ReplyCommand& typed) {
                trace.emplace_back(typed.bAccepted ? "reply accepted" : "reply refused");
                replies[typed.replyToken] = typed;
            },
            [this, &acknowledged](const SendReport& typed) {
                const bool bStored = std::ranges::any_of(store.GetState().outbox, [&typed](const OutboxEntry& entry) {
                    return entry == typed.entry;
                });
                if (!bStored)
                {
                    violations.push_back("sent before it was stored: " + DescribeReport(typed.entry.report));
                }
                trace.push_back("report " + DescribeReport(typed.entry.report));
                reports.push_back(typed.entry);
                if (bAcknowledges)
                {
                    acknowledged.push_back(typed.entry.sequence);
                }
            },
            [this](const CommandRobot& typed) {
                trace.push_back(fmt::format("command {} {}", typed.robotID, DescribeCommand(typed.command)));
                if (const auto* driveOrNull = std::get_if<Drive>(&typed.command); driveOrNull != nullptr)
                {
                    driveIDs[typed.robotID] = driveOrNull->driveID;
                }
                AdapterActions out;
                GetRobot(typed.robotID).Handle(typed.command, GetNow(), out);
                // What a robot says to a command comes later, never inside the command.
                const bool bWasExecuting = std::exchange(_bExecuting, true);
                ExecuteRobot(typed.robotID, out);
                _bExecuting = bWasExecuting;
            },
            [this](const RobotStatusChanged& typed) {
                trace.push_back(fmt::format(
                    "status {} {} {}",
                    typed.status.robotID,
                    GetText(typed.status.status),
                    typed.status.position));
            },
            [this](const TscStateChanged& typed) { trace.push_back(fmt::format("tsc {}", GetText(typed.state))); },
            [this](const StartEngineTimer& typed) {
                Push({{}, 0, {}, typed.timer, 0, 0}, typed.delay);
            },
            [this](const CancelEngineTimer& typed) {
                _engineTimers[typed.timer] = 0;
            }},
        action);
}

void PlanWorld::ExecuteRobot(const std::string& robotID, const AdapterActions& actions)
{
    for (const AdapterAction& action : actions)
    {
        std::visit(
            Core::Overloaded{
                [this, &robotID](const RaiseEvent& typed) { _delayed.emplace_back(robotID, typed.event); },
                [this, &robotID](const StartAdapterTimer& typed) {
                    Push({{}, 0, robotID, {}, typed.timer, 0}, typed.delay);
                },
                [this, &robotID](const CancelAdapterTimer& typed) {
                    _robotTimers[{robotID, typed.timer}] = 0;
                }},
            action);
    }
    RaiseDelayed();
}

/// What robots told, in its order: nothing overtakes what was told before it.
void PlanWorld::RaiseDelayed()
{
    if (std::exchange(_bExecuting, true))
    {
        return;
    }
    while (!_delayed.empty())
    {
        const auto [robotID, event] = std::move(_delayed.front());
        _delayed.pop_front();
        Raise(robotID, event);
    }
    _bExecuting = false;
}

/// Never two robots on one node.
void PlanWorld::CheckOccupancy()
{
    std::map<std::string, std::string> holders;
    for (const auto& [robotID, robot] : _robots)
    {
        for (const std::string& nodeID : robot->GetOccupied())
        {
            const auto [place, bNew] = holders.emplace(nodeID, robotID);
            if (!bNew)
            {
                violations.push_back(fmt::format("{} and {} are on {}", place->second, robotID, nodeID));
            }
        }
    }
}

} // namespace ACS::Testing
