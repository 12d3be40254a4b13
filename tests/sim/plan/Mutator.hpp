#pragma once

#include "ChanceModel.hpp"
#include "EMutation.hpp"
#include <acs/plan/EngineAction.hpp>
#include <acs/plan/IPlanStore.hpp>
#include <acs/plan/RobotCommand.hpp>
#include <acs/plan/RobotEvent.hpp>
#include <acs/protocol/AcsMessage.hpp>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Simulation
{

/// Changes the inputs and outputs of AcsdCore in one way at a time. Without a mutation everything passes
/// unchanged, and no random number is drawn.
class Mutator final
{
public:
    struct CommandOutcome
    {
        std::vector<Planning::RobotCommand> sent;
        std::vector<Planning::RobotCommand> sentLater;
        std::vector<Planning::RobotEvent> raised;
    };

private:
    EMutation _mutation;
    ChanceModel& _chance;
    Core::IRandom& _random;
    std::optional<Protocol::AcsRequest> _heldBack;
    std::map<std::string, Planning::Drive> _drives;                                ///< The latest of each robot.
    std::set<std::string> _denied;                                                 ///< CommandIDs.
    std::map<std::pair<std::string, std::string>, Planning::StartJob> _latestJobs; ///< By robot and action.
    std::set<std::string> _losers;     ///< Robots that rejected or lost a drive, until their next step.
    std::set<std::string> _lostPlans;  ///< Plans with a step of such a robot.
    std::set<std::string> _stationary; ///< Robots that count as stationary until their next drive.

public:
    Mutator(EMutation mutation, ChanceModel& chance, Core::IRandom& random);

    [[nodiscard]] bool Is(EMutation mutation) const noexcept;
    [[nodiscard]] Planning::StoredState OnRestore(Planning::StoredState state) const;
    [[nodiscard]] Planning::StoreBatch OnWrite(Planning::StoreBatch batch) const;
    [[nodiscard]] Planning::ReplyCommand OnReply(Planning::ReplyCommand reply) const;
    /// Nullopt: the report is dropped, and the engine receives an acknowledgement.
    [[nodiscard]] std::optional<Planning::OutboxEntry> PassReportOrNull(Planning::OutboxEntry entry);
    /// The requests to send in place of this one. Only the first must be sent.
    [[nodiscard]] std::vector<Protocol::AcsRequest> OnSend(const Protocol::AcsRequest& request);
    [[nodiscard]] CommandOutcome OnCommand(const Planning::CommandRobot& command);
    [[nodiscard]] std::vector<Planning::RobotEvent> OnEvent(
        const std::string& robotID,
        const Planning::RobotEvent& event);
    [[nodiscard]] bool ShouldForgetTimer() const;

private:
    [[nodiscard]] Planning::StartJob Misdirect(const std::string& robotID, Planning::StartJob job);
};

} // namespace ACS::Simulation
