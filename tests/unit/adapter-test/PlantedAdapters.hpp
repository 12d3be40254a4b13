#pragma once

// Adapters with one defect each, see PlantedDefectTest.cpp.

#include "ReferenceAdapter.hpp"
#include <acs/plan/RobotEvent.hpp>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Testing
{

struct Deaf final : ReferenceAdapter
{
    void Handle(const Planning::RobotCommand& /*command*/, Core::Now /*now*/, Out& /*out*/) override
    {
    }
    void OnLinkUp(Out& /*out*/) override
    {
    }
    void OnLinkDown(Out& /*out*/) override
    {
    }
    void OnMessage(const ReferenceMessage& /*message*/, Out& /*out*/) override
    {
    }
};

struct KeepsOutput final : ReferenceAdapter
{
    Out* firstOrNull = nullptr;

    void OnMessage(const ReferenceMessage& message, Out& out) override
    {
        firstOrNull = firstOrNull == nullptr ? &out : firstOrNull;
        ReferenceAdapter::OnMessage(message, *firstOrNull);
    }
};

struct RestartsTimer final : ReferenceAdapter
{
    void OnLinkUp(Out& out) override
    {
        ReferenceAdapter::OnLinkUp(out);
        out.emplace_back(Planning::StartAdapterTimer{1, Core::Duration::zero()});
    }
    void OnTimer(Planning::AdapterTimerID timer, Core::Now /*now*/, Out& out) override
    {
        out.emplace_back(Planning::StartAdapterTimer{timer, Core::Duration::zero()});
    }
};

struct RejectsWhenOnline final : ReferenceAdapter
{
    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(std::string_view /*action*/) const override
    {
        return _bOnline ? std::optional<std::string>("it is busy") : std::nullopt;
    }
};

struct HidesLinkLoss final : ReferenceAdapter
{
    void OnLinkDown(Out& /*out*/) override
    {
        _state.reset();
    }
};

/// Shows the command that it has sent, not the one that the robot has received.
struct ShowsSentCommand final : ReferenceAdapter
{
    void Raise(Planning::RobotEvent event, Out& out) override
    {
        if (auto* const stateOrNull = std::get_if<Planning::StateChanged>(&event))
        {
            stateOrNull->restartEvidence.commandID = _job.has_value() ? "sent-" + _job->commandID : std::string();
        }
        ReferenceAdapter::Raise(std::move(event), out);
    }
};

/// Remembers a cancellation that has come too late, for the next drive.
struct CancelsNextDrive final : ReferenceAdapter
{
    void OnCancelDrive(const Planning::CancelDrive& /*command*/, Out& out) override
    {
        _bCancelsDrive = true;
        ContinueDrive(out);
    }
    void OnDrive(const Planning::Drive& command, Out& out) override
    {
        _drive = command;
        _passedCount = 0;
        ContinueDrive(out);
        _bCancelsDrive = false;
    }
};

struct LosesOfflineJob final : ReferenceAdapter
{
    void OnStartJob(const Planning::StartJob& command, Out& out) override
    {
        if (_bOnline)
        {
            ReferenceAdapter::OnStartJob(command, out);
        }
    }
};

struct IgnoresExtension final : ReferenceAdapter
{
    void OnExtendDrive(const Planning::ExtendDrive& /*command*/, Out& /*out*/) override
    {
    }
};

struct DrivesBeyondBase final : ReferenceAdapter
{
    void OnDrive(const Planning::Drive& command, Out& out) override
    {
        Planning::Drive whole = command;
        whole.releasedCount = whole.route.nodes.size();
        ReferenceAdapter::OnDrive(whole, out);
    }
};

struct ArrivesEarly final : ReferenceAdapter
{
    void Send(ReferenceMessage message) override
    {
        const bool bLast = message.kind == EKind::Go && _passedCount + 1 == _drive->route.nodes.size();
        ReferenceAdapter::Send(std::move(message));
        _bArrives = _bArrives || bLast;
    }
    void ContinueDrive(Out& out) override
    {
        ReferenceAdapter::ContinueDrive(out);
        if (std::exchange(_bArrives, false) && _drive.has_value())
        {
            EndDrive(Planning::Arrived{_drive->driveID}, out);
        }
    }

private:
    bool _bArrives = false;
};

struct IgnoresCancel final : ReferenceAdapter
{
    void OnCancelDrive(const Planning::CancelDrive& /*command*/, Out& /*out*/) override
    {
    }
};

struct CancelsBeforeStop final : ReferenceAdapter
{
    void OnCancelDrive(const Planning::CancelDrive& command, Out& out) override
    {
        if (_drive.has_value() && _state.has_value())
        {
            EndDrive(Planning::DriveCancelled{command.driveID, _state->nodeID}, out);
        }
    }
};

struct RejectsBeforeStop final : ReferenceAdapter
{
    void OnCancelDrive(const Planning::CancelDrive& command, Out& out) override
    {
        if (_drive.has_value())
        {
            EndDrive(Planning::DriveRejected{command.driveID, "it was cancelled"}, out);
        }
    }
};

/// The robot may have executed the job already, under another ID.
struct RepeatsJobAfterReconnect final : ReferenceAdapter
{
    void OnLinkUp(Out& out) override
    {
        ReferenceAdapter::OnLinkUp(out);
        if (_job.has_value())
        {
            _job->commandID += "-again";
            Send({EKind::Do, _job->commandID});
        }
    }
};

/// Concludes from the request that the job was commanded, and from the silence that it is done.
struct RecoversWithoutAsking final : ReferenceAdapter
{
    void OnRecoverJob(const Planning::RecoverJob& command, Out& out) override
    {
        Raise(Planning::JobFinished{command.job.jobID}, out);
    }
};

struct AnswersUnknownWithDone final : ReferenceAdapter
{
    void OnJobState(const std::string& text, Out& out) override
    {
        ReferenceAdapter::OnJobState(text == "unknown" ? "done" : text, out);
    }
};

struct RecoversByStarting final : ReferenceAdapter
{
    void OnRecoverJob(const Planning::RecoverJob& command, Out& out) override
    {
        OnStartJob(command.job, out);
    }
};

/// Reports an unknown job, although a StartJob of this adapter's predecessor may be in transit.
struct RecoversAsUnknown final : ReferenceAdapter
{
    void OnRecoverJob(const Planning::RecoverJob& command, Out& out) override
    {
        Raise(Planning::JobUnknown{command.job.jobID}, out);
    }
};

struct IgnoresJobCancel final : ReferenceAdapter
{
    void OnCancelJob(const Planning::CancelJob& /*command*/, Out& /*out*/) override
    {
    }
};

/// Forgets the pause when the drive is extended.
struct ForgetsPause final : ReferenceAdapter
{
    void OnExtendDrive(const Planning::ExtendDrive& command, Out& out) override
    {
        Send({EKind::Resume});
        ReferenceAdapter::OnExtendDrive(command, out);
    }
};

struct IgnoresResume final : ReferenceAdapter
{
    void OnResume(const Planning::Resume& /*command*/, Out& /*out*/) override
    {
    }
};

struct IgnoresStopCharging final : ReferenceAdapter
{
    void OnStopCharging(const Planning::StopCharging& /*command*/, Out& /*out*/) override
    {
    }
};

/// Shows the loads after a job only when it has ended the job.
struct ShowsLoadsLate final : ReferenceAdapter
{
    void Raise(Planning::RobotEvent event, Out& out) override
    {
        if (auto* const stateOrNull = std::get_if<Planning::StateChanged>(&event))
        {
            _shown = _job.has_value() && _shown.has_value() ? _shown : stateOrNull->loads;
            stateOrNull->loads = _shown;
        }
        ReferenceAdapter::Raise(std::move(event), out);
    }

private:
    std::optional<std::vector<Planning::PortLoad>> _shown;
};

struct IsIncompatible final : ReferenceAdapter
{
    void OnLinkUp(Out& out) override
    {
        Raise(Planning::CompatibilityChanged{"it is too wide"}, out);
        ReferenceAdapter::OnLinkUp(out);
    }
};

} // namespace ACS::Testing
