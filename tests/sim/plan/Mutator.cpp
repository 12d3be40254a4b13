#include "Mutator.hpp"

#include <acs/core/Uuid.hpp>
#include <acs/plan/PlanTransitions.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <variant>

namespace ACS::Simulation
{

namespace
{

/// "CR01.TP02" of "CR01.TP01".
std::optional<std::string> MakeNextOrNull(const std::optional<std::string>& placeOrNull)
{
    constexpr std::size_t DIGITS = 2;
    if (!placeOrNull.has_value() || placeOrNull->size() < DIGITS)
    {
        return placeOrNull;
    }
    const std::string number = placeOrNull->substr(placeOrNull->size() - DIGITS);
    return placeOrNull->substr(0, placeOrNull->size() - DIGITS) + fmt::format("{:02}", std::stoi(number) + 1);
}

bool IsFinalReport(const Planning::Report& report)
{
    const auto* const planOrNull = std::get_if<Planning::PlanReport>(&report);
    return planOrNull != nullptr && Planning::IsFinal(planOrNull->state);
}

bool IsResult(const Protocol::AcsPayload& payload)
{
    return std::holds_alternative<Protocol::CancelResultReport>(payload)
        || std::holds_alternative<Protocol::AbortResultReport>(payload)
        || std::holds_alternative<Protocol::PauseResultReport>(payload)
        || std::holds_alternative<Protocol::ResumeResultReport>(payload);
}

} // namespace

Mutator::Mutator(EMutation mutation, ChanceModel& chance, Core::IRandom& random)
    : _mutation(mutation),
      _chance(chance),
      _random(random)
{
}

bool Mutator::Is(EMutation mutation) const noexcept
{
    return _mutation == mutation;
}

Planning::StoredState Mutator::OnRestore(Planning::StoredState state) const
{
    const auto lost = std::ranges::find_if(state.plans, [](const Planning::PlanRecord& record) {
        return !Planning::IsFinal(record.progress.state);
    });
    if (Is(EMutation::RestoreDropsPlan) && lost != state.plans.end())
    {
        state.plans.erase(lost);
    }
    if (Is(EMutation::MaintenanceForgotten))
    {
        state.robotsInMaintenance.clear();
    }
    return state;
}

Planning::StoreBatch Mutator::OnWrite(Planning::StoreBatch batch) const
{
    if (Is(EMutation::OutboxForgets))
    {
        std::erase_if(batch.changes, [](const Planning::StoreChange& change) {
            const auto* const addedOrNull = std::get_if<Planning::ReportAdded>(&change);
            return addedOrNull != nullptr && IsFinalReport(addedOrNull->entry.report);
        });
    }
    return batch;
}

Planning::ReplyCommand Mutator::OnReply(Planning::ReplyCommand reply) const
{
    reply.bAccepted = reply.bAccepted || Is(EMutation::RefusalAcked);
    return reply;
}

std::optional<Planning::OutboxEntry> Mutator::PassReportOrNull(Planning::OutboxEntry entry)
{
    auto* const resultOrNull = std::get_if<Planning::ControlResultReport>(&entry.report);
    const bool bSwallowed = (Is(EMutation::PlanReportSwallowed) && IsFinalReport(entry.report) && _chance.IsHit(300))
        || (Is(EMutation::ResultSwallowed) && resultOrNull != nullptr);
    if (bSwallowed)
    {
        return std::nullopt;
    }
    if (Is(EMutation::ResultInverted) && resultOrNull != nullptr)
    {
        resultOrNull->bSucceeded = !resultOrNull->bSucceeded;
    }
    const auto* const stepOrNull = std::get_if<Planning::StepReport>(&entry.report);
    if (stepOrNull != nullptr && _losers.erase(stepOrNull->robotID) > 0)
    {
        _lostPlans.insert(stepOrNull->planID);
    }
    auto* const planOrNull = std::get_if<Planning::PlanReport>(&entry.report);
    if (Is(EMutation::LostDriveFailsPlan) && planOrNull != nullptr && _lostPlans.contains(planOrNull->planID)
        && planOrNull->state == Planning::EPlanState::Completed)
    {
        planOrNull->state = Planning::EPlanState::Failed;
    }
    return entry;
}

std::vector<Protocol::AcsRequest> Mutator::OnSend(const Protocol::AcsRequest& request)
{
    std::vector<Protocol::AcsRequest> sent{request};
    if (Is(EMutation::ReportsSwapped))
    {
        if (_heldBack.has_value())
        {
            sent.push_back(*std::exchange(_heldBack, std::nullopt));
        }
        else if (_chance.IsHit(100))
        {
            _heldBack = request;
            return {};
        }
    }
    const auto* const planOrNull = std::get_if<Protocol::PlanReport>(&request.payload);
    const bool bFinal = planOrNull != nullptr && Protocol::IsFinal(planOrNull->status);
    const bool bTwice =
        (Is(EMutation::FinalReportTwice) && bFinal) || (Is(EMutation::ResultTwice) && IsResult(request.payload));
    const bool bInvented = Is(EMutation::ReportNotStored) && _chance.IsHit(50);
    if (bTwice || bInvented)
    {
        sent.push_back(request);
        sent.back().transactionID = Core::MakeUUID(_random);
    }
    if (bInvented)
    {
        sent.back().payload = Protocol::ErrorReport{};
    }
    return sent;
}

Mutator::CommandOutcome Mutator::OnCommand(const Planning::CommandRobot& command)
{
    CommandOutcome outcome{{command.command}, {}, {}};
    if (const auto* driveOrNull = std::get_if<Planning::Drive>(&command.command); driveOrNull != nullptr)
    {
        _drives[command.robotID] = *driveOrNull;
        _stationary.erase(command.robotID);
    }
    if (Is(EMutation::ResumeSwallowed) && std::holds_alternative<Planning::Resume>(command.command))
    {
        outcome.sent.clear();
    }
    const auto* const jobOrNull = std::get_if<Planning::StartJob>(&command.command);
    if (Is(EMutation::JobStartedTwice) && jobOrNull != nullptr && _chance.IsHit(200))
    {
        Planning::StartJob again = *jobOrNull;
        again.commandID = Core::MakeUUID(_random);
        outcome.sentLater.emplace_back(std::move(again));
    }
    if (jobOrNull != nullptr)
    {
        std::get<Planning::StartJob>(outcome.sent.front()) = Misdirect(command.robotID, *jobOrNull);
    }
    const auto* const recoveryOrNull = std::get_if<Planning::RecoverJob>(&command.command);
    if (Is(EMutation::RecoveryDenied) && recoveryOrNull != nullptr)
    {
        _denied.insert(recoveryOrNull->job.commandID);
        return {{}, {}, {Planning::JobUnknown{recoveryOrNull->job.jobID}}};
    }
    if (jobOrNull != nullptr && _denied.contains(jobOrNull->commandID))
    {
        Planning::StartJob again = *jobOrNull;
        again.commandID = Core::MakeUUID(_random);
        outcome.sent = {std::move(again)};
    }
    const auto* const cancelOrNull = std::get_if<Planning::CancelDrive>(&command.command);
    if (Is(EMutation::StationaryTooEarly) && cancelOrNull != nullptr)
    {
        outcome.raised.emplace_back(Planning::DriveCancelled{cancelOrNull->driveID, {}});
        _stationary.insert(command.robotID);
    }
    return outcome;
}

/// Replaces the places that the engine has chosen.
Planning::StartJob Mutator::Misdirect(const std::string& robotID, Planning::StartJob job)
{
    const auto latest = _latestJobs.try_emplace({robotID, job.action}, job).first;
    const Planning::StartJob before = std::exchange(latest->second, job);
    if (Is(EMutation::InputsOfAnotherJob))
    {
        job.from = before.from;
        job.to = before.to;
        job.carrierID = before.carrierID;
    }
    const bool bRobotFirst = job.from.has_value() && job.from->starts_with(robotID + ".");
    if (Is(EMutation::PortOffByOne))
    {
        (bRobotFirst ? job.from : job.to) = MakeNextOrNull(bRobotFirst ? job.from : job.to);
    }
    if (Is(EMutation::WrongPlace))
    {
        (bRobotFirst ? job.to : job.from) = MakeNextOrNull(bRobotFirst ? job.to : job.from);
    }
    return job;
}

std::vector<Planning::RobotEvent> Mutator::OnEvent(const std::string& robotID, const Planning::RobotEvent& event)
{
    std::vector<Planning::RobotEvent> events{event};
    if (std::holds_alternative<Planning::DriveRejected>(event))
    {
        _losers.insert(robotID);
    }
    auto* const stateOrNull = std::get_if<Planning::StateChanged>(&events.front());
    if (Is(EMutation::StationaryTooEarly) && stateOrNull != nullptr
        && (stateOrNull->bOccupied || _stationary.contains(robotID)))
    {
        stateOrNull->bDriving = false;
        stateOrNull->bOccupied = false;
        stateOrNull->bPoseKnown = false;
        stateOrNull->heldNodeIDs.clear();
    }
    const auto* const startedOrNull = std::get_if<Planning::JobStarted>(&event);
    if (Is(EMutation::JobFinishedEarly) && startedOrNull != nullptr)
    {
        events.emplace_back(Planning::JobFinished{startedOrNull->jobID});
    }
    const auto* const passedOrNull = std::get_if<Planning::NodePassed>(&event);
    if (Is(EMutation::NodePassedEarly) && passedOrNull != nullptr)
    {
        const std::vector<Planning::RouteNode>& nodes = _drives.at(robotID).route.nodes;
        const auto found = std::ranges::find(nodes, passedOrNull->nodeID, &Planning::RouteNode::nodeID);
        if (found != nodes.end() && std::next(found) != nodes.end())
        {
            events.emplace_back(Planning::NodePassed{passedOrNull->driveID, std::next(found)->nodeID});
        }
    }
    return events;
}

bool Mutator::ShouldForgetTimer() const
{
    return Is(EMutation::TimerForgotten) && _chance.IsHit(700);
}

} // namespace ACS::Simulation
