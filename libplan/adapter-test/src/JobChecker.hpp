#pragma once

#include "FindingSink.hpp"
#include <acs/adapter_test/IAdapterBench.hpp>
#include <acs/plan/RobotCommand.hpp>
#include <acs/plan/RobotEvent.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

namespace ACS::AdapterTest
{

/// The jobs of a scenario: compares their events with how often the robot has done them.
class JobChecker
{
public:
    enum class EAnswer : std::uint8_t
    {
        None,
        Started,
        Finished,
        Failed,
        Rejected,
        Interrupted,
        Unknown,
        Unresolved,
    };

private:
    struct Record
    {
        std::string commandID;
        bool bSent = false;                 ///< StartJob was commanded, not only RecoverJob.
        std::size_t doneBefore = 0;         ///< Jobs that the robot had done before this one.
        std::optional<std::size_t> doneEnd; ///< Likewise when the next one was commanded.
        EAnswer answer = EAnswer::None;     ///< The latest since the last StartJob or RecoverJob.
        bool bNotDone = false;              ///< The adapter has stated that the robot has not done it.
    };

    FindingSink _sink;
    std::map<std::string, Record> _records; ///< By jobID.
    std::string _currentID;                 ///< The job that was commanded last.
    std::string _lastText;                  ///< The last event of a job, for findings.

public:
    explicit JobChecker(FindingSink sink);

    void OnStart(const Planning::StartJob& job, const RobotTruth& truth);
    void OnRecover(const Planning::RecoverJob& recover, const RobotTruth& truth);

    void OnStarted(const Planning::JobStarted& event);
    void OnFinished(const Planning::JobFinished& event, const RobotTruth& truth);
    void OnFailed(const Planning::JobFailed& event, const RobotTruth& truth);
    void OnRejected(const Planning::JobRejected& event, const RobotTruth& truth);
    void OnInterrupted(const Planning::JobInterrupted& event, const RobotTruth& truth);
    void OnUnknown(const Planning::JobUnknown& event, const RobotTruth& truth);
    void OnUnresolved(const Planning::JobUnresolved& event);

    void Sample(const RobotTruth& truth);

    /// Of the job that was commanded last.
    [[nodiscard]] EAnswer GetAnswer() const;
    [[nodiscard]] bool HasEnded() const;
    [[nodiscard]] const std::string& GetLastText() const noexcept;

private:
    [[nodiscard]] static std::size_t CountDone(const Record& record, const RobotTruth& truth);
    [[nodiscard]] static bool IsEnd(EAnswer answer) noexcept;
    void Begin(const Planning::StartJob& job, bool bSent, const RobotTruth& truth);
    /// The record of the event's job if it is open; null, with a finding, if it is not.
    [[nodiscard]] Record* FindOpenOrNull(const std::string& jobID, const Planning::RobotEvent& event);
    void EndUndone(
        const std::string& jobID,
        const Planning::RobotEvent& event,
        EAnswer answer,
        const RobotTruth& truth);
};

} // namespace ACS::AdapterTest
