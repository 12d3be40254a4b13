#pragma once

#include "AcsdTimer.hpp"
#include "operator/RefusedOffer.hpp"
#include <acs/core/Now.hpp>
#include <acs/plan/EngineAction.hpp>

#include <string>

namespace ACS::Acsd
{

/// The I/O that AcsdCore needs besides the session with the MCS.
class IAcsdOutput
{
public:
    IAcsdOutput() = default;
    IAcsdOutput(const IAcsdOutput&) = delete;
    IAcsdOutput& operator=(const IAcsdOutput&) = delete;
    virtual ~IAcsdOutput() = default;

    /// Stores the batch as one transaction and reports the outcome to AcsdCore::OnStored.
    virtual void Store(const Planning::StoreBatch& batch) = 0;
    /// Checks the files of the store and its log, and reports to AcsdCore::OnStoreLost or OnStoreLog.
    virtual void CheckStore() = 0;
    /// The robot reports to AcsdCore::OnRobotEvent, later or from within.
    virtual void CommandRobot(const Planning::CommandRobot& command) = 0;

    /// Calls AcsdCore::OnTimer after the delay. Restarts a timer that is running.
    virtual void StartTimer(const AcsdTimer& timer, Core::Duration delay) = 0;
    virtual void CancelTimer(const AcsdTimer& timer) = 0;
    virtual void CancelTimers() = 0;

    /// A command of the operator that was accepted is not executed after all.
    virtual void OnOperatorRefused(const RefusedOffer& refused) = 0;

    /// Closes the links to the MCS, the broker and the arms, then calls AcsdCore::OnLinksClosed.
    virtual void CloseLinks() = 0;
    /// The stop is complete. Last call.
    virtual void OnStopped() = 0;
    /// Another program has taken the store: end at once, as in a crash. Last call.
    virtual void OnStoreTaken(const std::string& reason) = 0;

    /// Duration of a transaction of the store.
    virtual void ObserveCommit(Core::Duration duration) = 0;
    /// From sending a report to its Ack.
    virtual void ObserveAckWait(Core::Duration wait) = 0;
};

} // namespace ACS::Acsd
