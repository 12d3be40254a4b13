// Lesson 9: a whole ACS in one file, with a robot of its own kind. It needs ACS::ProtocolBeast and nothing else of the
// SDK, speaks to any MCS, and does what the document asks of an ACS: plans in their order, cancel, abort, pause, resume,
// the states of the TSC, errors set and cleared.
//
//     mcs-sim --listen 127.0.0.1:9001 --scenario examples/scenarios/pause-resume.json
//     e09_small_acs ws://127.0.0.1:9001/acs/ outbox.log
//
// The operator's commands come from the keyboard: pause, auto, error, clear, quit. The robot is a timer: a drive takes a
// second, a job takes another. Reports survive in the file; plans do not: a real ACS stores them as well, see libplan's
// IPlanStore.

#include "ExampleClock.hpp"
#include "ExampleLines.hpp"
#include "ExampleRandom.hpp"
#include "OutboxFile.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/protocol/DurableOutbox.hpp>
#include <acs/protocol_beast/AcsClient.hpp>

#include <boost/asio/io_context.hpp>
#include <boost/asio/signal_set.hpp>
#include <boost/asio/steady_timer.hpp>
#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdio>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <utility>
#include <variant>
#include <vector>

using namespace ACS;           // NOLINT(google-build-using-namespace): an example reads better without the prefix
using namespace ACS::Protocol; // NOLINT(google-build-using-namespace)

namespace
{

constexpr std::chrono::seconds ACTIVITY_TIME{1};
constexpr const char* ROBOT = "LR01";
constexpr const char* ERROR_CODE = "E-DOOR";

/// The plan that the robot works on, and how far it is.
struct ActivePlan
{
    ExecutionPlan plan;
    std::size_t step = 0;
    std::optional<std::size_t> job; ///< None: the robot drives to the step's position.
    bool bPaused = false;
    std::size_t aborts = 0; ///< Waiting for the end of the job, which is the last. Each gets its result.
};

class SmallACS final : public ProtocolBeast::ISessionHandler
{
    const Core::IClock& _clock;
    boost::asio::steady_timer _timer; ///< Runs while the robot does something.
    std::chrono::steady_clock::duration _remaining{};
    DurableOutbox& _outbox;
    std::deque<ExecutionPlan> _waiting;
    std::optional<ActivePlan> _active;
    std::set<std::string> _knownPlans;
    ETscState _tsc = ETscState::Auto;
    bool _bError = false;

public:
    std::unique_ptr<ProtocolBeast::AcsClient> client;
    std::function<void(int exitCode)> onStopped;

    SmallACS(boost::asio::io_context& io, const Core::IClock& clock, DurableOutbox& outbox)
        : _clock(clock),
          _timer(io),
          _outbox(outbox)
    {
    }

    /// The client sends the latest of each status on every connection.
    void Start()
    {
        client->SendStatus(TscStateUpdate{_tsc});
        client->SendStatus(AcsCommStateUpdate{true});
        TellRobot(ERobotStatus::Idle);
        client->Start();
    }

    void OnSessionEvent(const SessionEvent& event) override
    {
        Check(_outbox.OnEvent(event));
        _outbox.Feed(*client);
        std::visit(
            Core::Overloaded{
                [this](const RequestReceived& received) {
                    if (!received.bDuplicate)
                    {
                        OnRequest(received.request);
                    }
                },
                [this](const Stopped& /*event*/) { onStopped(0); },
                [](const auto& /*other*/) {
                }},
            event);
    }

    void OnOperator(const std::string& line)
    {
        if (line == "pause" && _tsc == ETscState::Auto)
        {
            // The running plan is completed (SEMI E82), and no other one is started.
            SetTSC(ETscState::Pausing);
            StartNext();
        }
        else if (line == "auto" && _tsc != ETscState::Auto)
        {
            SetTSC(ETscState::Auto);
            StartNext();
        }
        else if ((line == "error" && !_bError) || (line == "clear" && _bError))
        {
            _bError = !_bError;
            Report(MakeError(_bError));
        }
        else if (line == "quit")
        {
            client->Stop();
        }
        else
        {
            fmt::print("pause, auto, error, clear or quit; '{}' does nothing now\n", line);
        }
    }

private:
    // ---- what must reach the MCS

    void Report(AcsPayload payload)
    {
        Check(_outbox.Add(std::move(payload), {_clock.GetNow().wall, {}}));
        _outbox.Feed(*client);
    }

    /// A report that cannot be stored would be lost with the program: it ends instead.
    void Check(const Core::Result<void>& stored) const
    {
        if (!stored.has_value())
        {
            fmt::print("{}\n", Core::Describe(stored.error()));
            onStopped(1);
        }
    }

    void TellRobot(ERobotStatus status)
    {
        RobotStatusUpdate update;
        update.robotID = ROBOT;
        update.robotStatus = status;
        update.carrierIDs = {std::nullopt};
        if (_active.has_value())
        {
            const PlanStep& step = GetStep();
            update.planID = _active->plan.planID;
            update.stepNo = step.stepNo;
            if (_active->job.has_value() && *_active->job < step.jobs.size())
            {
                update.jobID = step.jobs[*_active->job].jobID;
            }
        }
        client->SendStatus(update);
    }

    void SetTSC(ETscState state)
    {
        _tsc = state;
        client->SendStatus(TscStateUpdate{state});
    }

    [[nodiscard]] static ErrorReport MakeError(bool bSet)
    {
        return {ROBOT, {}, bSet, {}, {}, ERROR_CODE, EErrorLevel::Light, "the door is open"};
    }

    // ---- what the MCS asks for; each request is answered once

    void OnRequest(const AcsRequest& request)
    {
        std::visit(
            Core::Overloaded{
                [&](const ExecutionPlan& plan) { OnPlan(request, plan); },
                [&](const CancelPlan& control) { OnControl(request, control.planID, &SmallACS::Cancel); },
                [&](const AbortPlan& control) { OnControl(request, control.planID, &SmallACS::Abort); },
                [&](const PausePlan& control) { OnControl(request, control.planID, &SmallACS::Pause); },
                [&](const ResumePlan& control) { OnControl(request, control.planID, &SmallACS::Resume); },
                [&](const RequestAcsErrorList& /*request*/) {
                    ErrorListAck list;
                    list.errors.assign(_bError ? 1 : 0, MakeError(true));
                    client->Answer(GetCommand(request), request.transactionID, EAckResult::Success, "", list);
                },
                [&](const auto& /*other*/) {
                    const char* const reason = "this small ACS does not keep that";
                    client->Answer(GetCommand(request), request.transactionID, EAckResult::Fail, reason, EmptyAck{});
                }},
            request.payload);
    }

    void OnPlan(const AcsRequest& request, const ExecutionPlan& plan)
    {
        const bool bNew = _knownPlans.insert(plan.planID).second;
        client->Answer(
            GetCommand(request),
            request.transactionID,
            bNew ? EAckResult::Success : EAckResult::Fail,
            bNew ? "" : "Duplicated Plan",
            PlanAck{plan.planID});
        if (bNew)
        {
            _waiting.push_back(plan);
            auto& steps = _waiting.back().steps;
            std::sort(steps.begin(), steps.end(), [](const PlanStep& left, const PlanStep& right) {
                return left.stepNo < right.stepNo;
            });
            StartNext();
        }
    }

    /// Acknowledged first, feasible or not; what became of it follows as a report.
    void OnControl(const AcsRequest& request, const std::string& planID, void (SmallACS::*control)(const std::string&))
    {
        const EAckResult result = _knownPlans.contains(planID) ? EAckResult::Success : EAckResult::Fail;
        client->Answer(GetCommand(request), request.transactionID, result, "", PlanAck{planID});
        (this->*control)(planID);
    }

    [[nodiscard]] bool IsActive(const std::string& planID) const
    {
        return _active.has_value() && _active->plan.planID == planID;
    }

    [[nodiscard]] bool TryForgetWaiting(const std::string& planID)
    {
        return std::erase_if(_waiting, [&planID](const ExecutionPlan& plan) { return plan.planID == planID; }) > 0;
    }

    /// Until the robot has arrived for the first time.
    void Cancel(const std::string& planID)
    {
        const bool bBeforeArrival = IsActive(planID) && _active->step == 0 && !_active->job.has_value();
        if (!bBeforeArrival && !TryForgetWaiting(planID))
        {
            Report(CancelResultReport{planID, EReportResult::Failed, "it has arrived, or there is no such plan"});
            return;
        }
        if (bBeforeArrival && _active->bPaused)
        {
            Report(PlanReport{planID, EPlanStatus::InProgress, ""}); // Paused is not followed by Cancelled.
        }
        Report(PlanReport{planID, EPlanStatus::Cancelled, ""});
        Report(CancelResultReport{planID, EReportResult::Success, ""});
        Leave(planID);
    }

    /// A job that runs is let to its end.
    void Abort(const std::string& planID)
    {
        if (IsActive(planID) && _active->job.has_value() && !_active->bPaused)
        {
            ++_active->aborts;
        }
        else if (IsActive(planID) || TryForgetWaiting(planID))
        {
            FinishAbort(planID, 1);
        }
        else
        {
            Report(AbortResultReport{planID, EReportResult::Failed, "there is no such plan"});
        }
    }

    void FinishAbort(const std::string& planID, std::size_t aborts)
    {
        Report(PlanReport{planID, EPlanStatus::Aborted, ""});
        for (; aborts > 0; --aborts)
        {
            Report(AbortResultReport{planID, EReportResult::Success, ""});
        }
        Leave(planID);
    }

    void Pause(const std::string& planID)
    {
        if (!IsActive(planID) || _active->bPaused || _active->aborts > 0)
        {
            Report(PauseResultReport{planID, EReportResult::Failed, "the plan does not run"});
            return;
        }
        // This robot stops at once; a real one is waited for.
        _remaining = std::max(_timer.expiry() - std::chrono::steady_clock::now(), {});
        _timer.cancel();
        _active->bPaused = true;
        TellRobot(ERobotStatus::Stopped);
        Report(PlanReport{planID, EPlanStatus::Paused, ""});
        Report(PauseResultReport{planID, EReportResult::Success, ""});
    }

    void Resume(const std::string& planID)
    {
        if (!IsActive(planID) || !_active->bPaused)
        {
            Report(ResumeResultReport{planID, EReportResult::Failed, "the plan is not paused"});
            return;
        }
        _active->bPaused = false;
        TellRobot(_active->job.has_value() ? ERobotStatus::Working : ERobotStatus::Moving);
        Report(PlanReport{planID, EPlanStatus::InProgress, ""});
        Report(ResumeResultReport{planID, EReportResult::Success, ""});
        Run(_remaining);
    }

    // ---- the robot: drives to the position of a step, does its jobs one after the other, drives on

    [[nodiscard]] const PlanStep& GetStep() const
    {
        return _active->plan.steps[_active->step];
    }

    void StartNext()
    {
        if (_active.has_value())
        {
            return;
        }
        if (_tsc == ETscState::Pausing)
        {
            SetTSC(ETscState::Paused);
        }
        if (_tsc == ETscState::Auto && !_waiting.empty())
        {
            _active = ActivePlan{std::move(_waiting.front()), 0, {}, false, 0};
            _waiting.pop_front();
            Report(PlanReport{_active->plan.planID, EPlanStatus::InProgress, ""});
            Drive();
        }
    }

    void Drive()
    {
        _active->job.reset();
        Report(StepReport{_active->plan.planID, ROBOT, GetStep().stepNo, EStepStatus::Dispatched, ""});
        Report(StepReport{_active->plan.planID, ROBOT, GetStep().stepNo, EStepStatus::InProgress, ""});
        TellRobot(ERobotStatus::Moving);
        Run(ACTIVITY_TIME);
    }

    void Run(std::chrono::steady_clock::duration time)
    {
        _timer.expires_after(time);
        _timer.async_wait([this](const boost::system::error_code& error) {
            if (!error && _active.has_value() && !_active->bPaused)
            {
                OnDone();
            }
        });
    }

    /// The drive, or the job, has ended.
    void OnDone()
    {
        if (!_active->job.has_value())
        {
            TellRobot(ERobotStatus::Arrival);
            BeginJob(0);
            return;
        }
        const std::size_t job = *_active->job;
        if (job < GetStep().jobs.size())
        {
            ReportJob(job, EJobStatus::Completed);
        }
        if (_active->aborts > 0)
        {
            FinishAbort(_active->plan.planID, _active->aborts);
        }
        else if (job + 1 < GetStep().jobs.size())
        {
            BeginJob(job + 1);
        }
        else
        {
            EndStep();
        }
    }

    /// A step without jobs (OpenSetCover) takes the time of one.
    void BeginJob(std::size_t job)
    {
        _active->job = job;
        TellRobot(ERobotStatus::Working);
        if (job < GetStep().jobs.size())
        {
            ReportJob(job, EJobStatus::Instructed);
            ReportJob(job, EJobStatus::InProgress);
        }
        Run(ACTIVITY_TIME);
    }

    void EndStep()
    {
        Report(StepReport{_active->plan.planID, ROBOT, GetStep().stepNo, EStepStatus::Completed, ""});
        if (++_active->step < _active->plan.steps.size())
        {
            Drive();
            return;
        }
        const std::string planID = _active->plan.planID;
        Report(PlanReport{planID, EPlanStatus::Completed, ""});
        Leave(planID);
    }

    void Leave(const std::string& planID)
    {
        if (IsActive(planID))
        {
            _timer.cancel();
            _active.reset();
            TellRobot(ERobotStatus::Idle);
        }
        StartNext();
    }

    void ReportJob(std::size_t job, EJobStatus status)
    {
        const PlanStep& step = GetStep();
        Report(JobReport{_active->plan.planID, ROBOT, step.stepNo, step.jobs[job].jobID, status, ""});
    }
};

} // namespace

int main(int argc, char** argv) // NOLINT(bugprone-exception-escape): nothing throws here but a full memory
{
    const std::vector<std::string> arguments(argv + 1, argv + argc); // NOLINT(*-pointer-arithmetic)
    if (arguments.empty() || arguments.size() > 2)
    {
        fmt::print("Usage: e09_small_acs URL [OUTBOX]   (URL of the MCS, for example ws://127.0.0.1:9001/acs/)\n");
        return 2;
    }
    boost::asio::io_context io;
    const ExampleClock clock;
    ExampleRandom random;
    const Core::Logger logger;
    OutboxFile outboxFile;
    DurableOutbox outbox(outboxFile, random);
    if (arguments.size() == 2)
    {
        std::optional<std::vector<DurableRequest>> requests = outboxFile.OpenOrNull(arguments[1]);
        if (!requests.has_value())
        {
            fmt::print("{}: {}\n", arguments[1], std::generic_category().message(errno));
            return 2;
        }
        outbox.Restore(std::move(*requests));
    }
    SmallACS acs(io, clock, outbox);
    ProtocolBeast::ClientOptions options;
    options.url = arguments[0];
    auto client = ProtocolBeast::AcsClient::Create(io.get_executor(), clock, random, logger, options, acs);
    if (!client.has_value())
    {
        fmt::print("{}\n", Core::Describe(client.error()));
        return 2;
    }
    acs.client = std::move(*client);
    const ExampleLines operatorLines(
        io,
        [&acs](const std::string& line) { acs.OnOperator(line); },
        []() {}); // at the end of the input the ACS continues
    boost::asio::signal_set signals(io, SIGINT, SIGTERM);
    signals.async_wait([&acs](const boost::system::error_code& error, int /*number*/) {
        if (!error)
        {
            acs.client->Stop();
        }
    });
    int exitCode = 0;
    acs.onStopped = [&io, &exitCode](int code) {
        exitCode = code;
        io.stop();
    };
    acs.Start();
    fmt::print("ready\n");
    std::fflush(stdout);
    io.run();
    return exitCode;
}
