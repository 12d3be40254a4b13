#pragma once

#include <acs/core/IRandom.hpp>
#include <acs/plan/IPlanStore.hpp>
#include <acs/plan/RobotEvent.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Planning
{

/// What is stored of a robot's commands, so that after a restart its state shows whether it did more than was stored.
class WorkRecord
{
    std::string _commandID;               ///< Of its last drive or job.
    std::vector<std::string> _earlierIDs; ///< Of those before, the latest first.
    std::int32_t _jobNumber = 0;          ///< Of its last job; 0: none, or commanded by an older version.
    bool _bCommandTaken = false;          ///< It has shown that it had one of its commands.
    bool _bDoubtful = false;
    bool _bMarkDue = false;                    ///< Its mark is stored though nothing else has changed.
    std::optional<RobotWorkChanged> _evidence; ///< After a restart: what was stored, until the robot's first state.
    RobotWorkChanged _stored;

public:
    void Restore(const RobotWorkChanged& work);

    /// What the robot shows as it begins a plan is stored with that: what it shows beyond it after a crash was done for the
    /// plan.
    void BeginPlan(const std::optional<std::string>& shownCommandID);
    void AddCommand(const std::string& commandID);
    /// 1 to 2^31 - 1, and not the previous one; a repeated job keeps its number.
    [[nodiscard]] std::int32_t NumberJob(bool bRepeated, Core::IRandom& random);
    void MarkCommandTaken() noexcept;
    void MarkDoubtful() noexcept;
    /// True: it was doubtful.
    bool TryClearDoubt() noexcept;
    /// While the store fails work continues. After a crash the robot then shows what was not stored, or that it has forgotten
    /// its commands: the next jobs of its plan may be done already. True: this was its first state after a restart.
    [[nodiscard]] bool TryCheckEvidence(const StateChanged& state, bool bHasPlan);

    /// The parts of the record that this class knows.
    [[nodiscard]] RobotWorkChanged Make(const std::string& robotID) const;
    /// Whether the work must be stored. A changed mark alone is no reason: it is that of the moment of a command or of the end
    /// of a job.
    [[nodiscard]] bool TryBeginStore(const RobotWorkChanged& work);
    void OnStored(RobotWorkChanged work);

    [[nodiscard]] const RobotWorkChanged& GetStored() const noexcept;
    [[nodiscard]] const std::vector<std::string>& GetEarlierIDs() const noexcept;
    /// The robot may have done more jobs of its plan than were stored: an operator is asked about each.
    [[nodiscard]] bool IsDoubtful() const noexcept;
};

} // namespace ACS::Planning
