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

/// The stored commands of a robot. After a restart its state shows whether it did more than was stored.
class WorkRecord
{
    std::string _commandID;               ///< Of its last drive or job.
    std::vector<std::string> _earlierIDs; ///< Of those before, the latest first.
    std::int32_t _jobNumber = 0;          ///< Of its last job; 0: none, or commanded by an older version.
    bool _bCommandTaken = false;          ///< It has confirmed one of its commands.
    bool _bUnresolved = false;
    bool _bTokenDue = false;                   ///< Store the progress token although nothing else has changed.
    std::optional<RobotWorkChanged> _evidence; ///< After a restart: what was stored, until it is checked.
    RobotWorkChanged _stored;

public:
    void Restore(const RobotWorkChanged& work);

    /// Stores what the robot shows at the start of a plan. Whatever it shows beyond that after a crash was done for the plan.
    void BeginPlan(const std::optional<std::string>& evidentCommandIDOrNull);
    void AddCommand(const std::string& commandID);
    /// The robot never had the command. If it is sent again while the store fails, a robot that shows it after a crash has done
    /// more than was stored.
    void ForgetCommand(const std::string& commandID);
    /// 1 to 2^31 - 1, and not the previous one; a repeated job keeps its number.
    [[nodiscard]] std::int32_t NumberJob(bool bRepeated, Core::IRandom& random);
    void MarkCommandTaken() noexcept;
    void MarkUnresolved() noexcept;
    /// True: it was unresolved.
    bool TryResolve() noexcept;
    /// Work continues while the store fails. After a crash the robot may then show a command that was not stored, or none: the
    /// next jobs of its plan may be done already. True: this was its first state after a restart. One with a heavy error that lacks
    /// the progress token does not count.
    [[nodiscard]] bool TryCheckEvidence(const StateChanged& state, bool bHasPlan);

    /// A record with the members that this class has.
    [[nodiscard]] RobotWorkChanged Make(const std::string& robotID) const;
    /// Whether the record must be stored. A changed progress token alone is no reason: the token counts at a command or the
    /// end of a job.
    [[nodiscard]] bool TryBeginStore(const RobotWorkChanged& work);
    void OnStored(RobotWorkChanged work);

    [[nodiscard]] const RobotWorkChanged& GetStored() const noexcept;
    [[nodiscard]] const std::vector<std::string>& GetEarlierIDs() const noexcept;
    /// The robot may have done more jobs of its plan than were stored: an operator must resolve each.
    [[nodiscard]] bool IsUnresolved() const noexcept;
    /// Whether it may have done more is known: there was no restart, or it has shown its state since.
    [[nodiscard]] bool IsChecked() const noexcept;
};

} // namespace ACS::Planning
