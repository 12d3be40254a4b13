// Lesson 22: which rule of the contract an adapter of one's own breaks. ACS::AdapterTest commands the adapter in virtual time, loses
// the link and crashes the ACS at each point of a job. A bench joins the adapter to a model of the robot. The robot here does jobs only.

#include <acs/adapter_test/CheckAdapter.hpp>

#include <fmt/core.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

using namespace ACS::Planning;    // NOLINT(google-build-using-namespace): an example reads better without the prefix
using namespace ACS::AdapterTest; // NOLINT(google-build-using-namespace): likewise
namespace Core = ACS::Core;

namespace
{

/// The lines "do ID" and "ask ID" to the robot, "running ID", "done ID" and "unknown ID" from it.
class JobAdapter final : public IRobotAdapter
{
    const bool _bAsks; ///< After a reconnect. Otherwise it sends the job again, although the robot may have done it.
    std::vector<std::string> _lines;
    std::optional<StartJob> _job;

public:
    explicit JobAdapter(bool bAsks)
        : _bAsks(bAsks)
    {
    }

    void Handle(const RobotCommand& command, Core::Now /*now*/, AdapterActions& /*out*/) override
    {
        if (const auto* const jobOrNull = std::get_if<StartJob>(&command))
        {
            _job = *jobOrNull;
            _lines.push_back("do " + _job->commandID);
        }
        else if (const auto* const recoverOrNull = std::get_if<RecoverJob>(&command))
        {
            _job = recoverOrNull->job;
            _lines.push_back("ask " + _job->commandID);
        }
    }

    void OnTimer(AdapterTimerID /*timer*/, Core::Now /*now*/, AdapterActions& /*out*/) override
    {
    }

    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(std::string_view /*action*/) const override
    {
        return std::nullopt;
    }

    void OnLink(bool bUp, AdapterActions& out)
    {
        out.emplace_back(RaiseEvent{LinkChanged{bUp}});
        if (bUp)
        {
            StateChanged state;
            state.lastNodeID = "N1";
            out.emplace_back(RaiseEvent{std::move(state)});
        }
        if (bUp && _job.has_value())
        {
            _lines.push_back((_bAsks ? "ask " : "do ") + _job->commandID);
        }
    }

    void OnLine(const std::string& line, AdapterActions& out)
    {
        if (!_job.has_value() || !line.ends_with(_job->commandID))
        {
            return;
        }
        const std::string jobID = _job->jobID;
        if (line.starts_with("running"))
        {
            out.emplace_back(RaiseEvent{JobStarted{jobID}});
            return;
        }
        _job.reset();
        out.emplace_back(
            line.starts_with("done") ? RaiseEvent{JobFinished{jobID}}
                                     : RaiseEvent{JobUnknown{jobID}}); // commanded again
    }

    std::vector<std::string> TakeLines()
    {
        return std::exchange(_lines, {});
    }
};

/// A line takes 10 ms and a job 2 s. The robot is a few members: what it is doing, and what it has done.
class JobBench final : public IAdapterBench
{
    const bool _bAsks;
    IVirtualTime* _timeOrNull = nullptr;
    IAdapterHost* _hostOrNull = nullptr;
    std::unique_ptr<JobAdapter> _adapter;
    bool _bUp = true;
    bool _bConnected = false;
    int _connection = 0; ///< What is in transit over an earlier one is lost.
    std::string _running;
    std::multiset<std::string> _done;

public:
    explicit JobBench(bool bAsks)
        : _bAsks(bAsks)
    {
    }

    [[nodiscard]] BenchOptions GetOptions() const override
    {
        BenchOptions options;
        options.answerLimit = std::chrono::seconds(10);
        for (bool BenchOptions::*ability :
             {&BenchOptions::bSlow,
              &BenchOptions::bRefuses,
              &BenchOptions::bFails,
              &BenchOptions::bRepeats,
              &BenchOptions::bPausesDrives,
              &BenchOptions::bPausesJobs,
              &BenchOptions::bCancelsJobs,
              &BenchOptions::bCharges,
              &BenchOptions::bDrives})
        {
            options.*ability = false; // each is a step to a better bench
        }
        return options;
    }

    [[nodiscard]] StartJob MakeJob(std::size_t /*number*/) const override
    {
        return {};
    }

    void MakeRobot(IVirtualTime& time) override
    {
        _timeOrNull = &time;
        _bUp = true;
        _running.clear();
        _done.clear();
    }

    [[nodiscard]] IRobotAdapter& MakeAdapter(IAdapterHost& host) override
    {
        _hostOrNull = &host;
        _adapter = std::make_unique<JobAdapter>(_bAsks);
        ConnectLater();
        return *_adapter;
    }

    void DestroyAdapter() override
    {
        _adapter.reset();
        _bConnected = false;
    }

    void DestroyRobot() override
    {
    }

    void OnAdapterCalled() override
    {
        for (const std::string& line : _adapter->TakeLines())
        {
            Send([this, line] { OnLineOfAdapter(line); });
        }
    }

    void SetLink(bool bUp) override
    {
        _bUp = bUp;
        ++_connection;
        if (bUp)
        {
            ConnectLater();
        }
        else if (std::exchange(_bConnected, false))
        {
            _hostOrNull->Call([this](Core::Now /*now*/, AdapterActions& out) { _adapter->OnLink(false, out); });
        }
    }

    void SetConduct(EConduct /*conduct*/) override
    {
    }

    [[nodiscard]] RobotTruth GetTruth() const override
    {
        return {"N1", false, !_running.empty(), _done.size()};
    }

private:
    void Send(const std::function<void()>& deliver)
    {
        if (_bConnected)
        {
            _timeOrNull->Post(std::chrono::milliseconds(10), [this, deliver, connection = _connection] {
                if (connection == _connection && _bConnected)
                {
                    deliver();
                }
            });
        }
    }

    void ConnectLater()
    {
        _timeOrNull->Post(std::chrono::milliseconds(10), [this] {
            if (_bUp && !_bConnected && _adapter != nullptr)
            {
                ++_connection;
                _bConnected = true;
                _hostOrNull->Call([this](Core::Now /*now*/, AdapterActions& out) { _adapter->OnLink(true, out); });
            }
        });
    }

    void Answer(const std::string& id)
    {
        const std::string word = id == _running ? "running " : _done.contains(id) ? "done " : "unknown ";
        Send([this, line = word + id] {
            _hostOrNull->Call([this, &line](Core::Now /*now*/, AdapterActions& out) { _adapter->OnLine(line, out); });
        });
    }

    void OnLineOfAdapter(const std::string& line)
    {
        const std::string id = line.substr(line.find(' ') + 1);
        if (line.starts_with("do ") && _running.empty())
        {
            _running = id;
            _timeOrNull->Post(std::chrono::seconds(2), [this, id] {
                _running.clear();
                _done.insert(id);
                Answer(id);
            });
        }
        Answer(id);
    }
};

} // namespace

int main() // NOLINT(bugprone-exception-escape): nothing throws here but a full memory
{
    JobBench hasty(false);
    const ContractReport found = CheckAdapter(hasty);
    fmt::print("it sends its job again:\n{}", found.Describe());
    JobBench careful(true);
    const ContractReport none = CheckAdapter(careful);
    fmt::print(
        "it asks for its job:\n{}{} scenarios, {} findings\n",
        none.Describe(),
        none.scenarios.size(),
        none.findings.size());
    return found.HasFinding(ERule::JobOnce) && none.findings.empty() ? 0 : 1;
}
