#pragma once

#include "ReferenceMessage.hpp"
#include <acs/adapter_test/IAdapterBench.hpp>

#include <chrono>
#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Testing
{

/// A robot that keeps on disk which jobs it has executed. It exists without an adapter, and answers over any connection.
class ReferenceRobot
{
public:
    using Sender = std::function<void(const ReferenceMessage& message)>;

private:
    using EKind = ReferenceMessage::EKind;

    static constexpr std::chrono::milliseconds EDGE_TIME{5'000};
    static constexpr std::chrono::milliseconds JOB_TIME{4'000};
    static constexpr int SLOWNESS = 4;

    AdapterTest::IVirtualTime& _time;
    const Sender _send;
    AdapterTest::EConduct _conduct = AdapterTest::EConduct::Obeys;
    ReferenceMessage _state;                                  ///< What it shows.
    std::string _jobID;                                       ///< The commandID of the running job; empty: none.
    std::map<std::string, std::string, std::less<>> _journal; ///< What became of each job.
    std::size_t _doneJobs = 0;
    std::size_t _motion = 0; ///< The number of the last movement or piece of work: an older one has been stopped.

public:
    ReferenceRobot(AdapterTest::IVirtualTime& time, std::string nodeID, Sender send)
        : _time(time),
          _send(std::move(send))
    {
        _state.nodeID = std::move(nodeID);
    }

    void SetConduct(AdapterTest::EConduct conduct)
    {
        _conduct = conduct;
    }

    /// A connection was opened.
    void ShowState() const
    {
        _send(_state);
    }

    void OnMessage(const ReferenceMessage& message)
    {
        switch (message.kind)
        {
            case EKind::Go:
                Go(message);
                break;
            case EKind::Do:
                Do(message.id);
                break;
            case EKind::Ask:
                AnswerJob(message.id);
                break;
            case EKind::Cancel:
                EndJob(message.id, "failed");
                break;
            case EKind::Pause:
            case EKind::Resume:
                SetPaused(message.kind == EKind::Pause);
                break;
            case EKind::Charge:
            case EKind::StopCharging:
                _state.bCharging = message.kind == EKind::Charge;
                ShowState();
                break;
            case EKind::State:
            case EKind::GoRefused:
            case EKind::JobState:
            default:
                break;
        }
    }

    [[nodiscard]] AdapterTest::RobotTruth GetTruth() const
    {
        const bool bActive = !_state.bPaused;
        return {
            _state.nodeID,
            bActive && !_state.nextID.empty(),
            bActive && !_jobID.empty(),
            _doneJobs,
            std::vector<Planning::PortLoad>{{"CP01", _state.bLoaded, ""}}};
    }

private:
    [[nodiscard]] Core::Duration Scale(Core::Duration time) const
    {
        return _conduct == AdapterTest::EConduct::Slow ? SLOWNESS * time : time;
    }

    void Go(const ReferenceMessage& go)
    {
        _state.goID = go.id;
        if (_conduct == AdapterTest::EConduct::Refuses)
        {
            _send({EKind::GoRefused, go.id});
            ShowState();
            return;
        }
        _state.id = go.id.substr(0, go.id.find('/'));
        _state.bCharging = false;
        if (_state.nextID.empty() && _state.nodeID != go.nodeID)
        {
            _state.nextID = go.nodeID;
            Continue();
        }
        ShowState();
    }

    void Do(const std::string& commandID)
    {
        if (_journal.contains(commandID))
        {
            AnswerJob(commandID);
        }
        else if (_conduct == AdapterTest::EConduct::Refuses || !_jobID.empty())
        {
            _send({EKind::JobState, commandID, "", "", "", "refused"});
        }
        else
        {
            _jobID = commandID;
            _state.id = commandID;
            _journal[commandID] = "running";
            Continue();
            ShowState();
            AnswerJob(commandID);
        }
    }

    void AnswerJob(const std::string& commandID) const
    {
        const auto known = _journal.find(commandID);
        _send({EKind::JobState, commandID, "", "", "", known == _journal.end() ? "unknown" : known->second});
    }

    void EndJob(const std::string& commandID, const std::string& outcome)
    {
        if (_jobID != commandID)
        {
            return;
        }
        _jobID.clear();
        ++_motion;
        _journal[commandID] = outcome;
        if (outcome == "done")
        {
            ++_doneJobs;
            _state.bLoaded = !_state.bLoaded;
            ShowState();
        }
        AnswerJob(commandID);
    }

    void SetPaused(bool bPaused)
    {
        _state.bPaused = bPaused;
        Continue();
        ShowState();
    }

    /// Begins its movement or its job, again after a pause.
    void Continue()
    {
        const std::size_t motion = ++_motion;
        if (_state.bPaused || (_state.nextID.empty() && _jobID.empty()))
        {
            return;
        }
        _time.Post(Scale(_jobID.empty() ? EDGE_TIME : JOB_TIME), [this, motion] {
            if (motion == _motion)
            {
                Complete();
            }
        });
    }

    void Complete()
    {
        if (!_jobID.empty())
        {
            const std::string commandID = _jobID;
            EndJob(commandID, _conduct == AdapterTest::EConduct::Fails ? "failed" : "done");
            return;
        }
        _state.nodeID = std::exchange(_state.nextID, {});
        ShowState();
    }
};

} // namespace ACS::Testing
