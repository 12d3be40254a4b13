#pragma once

#include <acs/plan/CommandReceipt.hpp>
#include <acs/plan/EngineInput.hpp>
#include <acs/plan/OfferedCommand.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <variant>
#include <vector>

namespace ACS::Planning
{

/// The inputs that wait for the engine, limited in number (InputLimits). Order: acknowledgements, which are not stored at once;
/// events, timers and controls; plans; commands of the operator. A class that others were preferred to 16 times has its turn, and
/// the operator's commands with one that stops work are next, if the input before was another one.
/// Within a class the order is that of arrival. A control of a plan that still waits stays after it.
class InputQueue
{
public:
    /// Commands of one call of the engine. Several are all plans, or all of the operator.
    using Commands = std::vector<OfferedCommand>;

    /// Inputs of one call of the engine.
    using Next = std::variant<RobotInput, EngineTimer, StoreLog, Commands>;

private:
    enum class EClass : std::uint8_t
    {
        Urgent,
        Plans,
        Operator,
    };
    static constexpr std::size_t CLASSES = 3;

    using Inputs = std::list<std::variant<OfferedCommand, RobotInput, EngineTimer, StoreLog>>;
    using RobotInputs = std::deque<Inputs::iterator>; ///< Of one robot, oldest first.

    InputLimits _limits;
    std::set<std::uint64_t> _acknowledged; ///< Sequences of reports.
    Inputs _urgent;
    std::map<std::string, RobotInputs> _robots; ///< The events in _urgent.
    std::set<EngineTimer> _timers;              ///< Those in _urgent.
    std::optional<StoreLog> _storeLog;          ///< The latest; an empty one in _urgent has its place.
    std::deque<OfferedCommand> _plans;          ///< With the controls that stay after a plan.
    std::vector<OfferedCommand> _operator;
    bool _bStopWaits = false;  ///< One of them stops work.
    bool _bStopBefore = false; ///< Such commands were the latest input.
    std::size_t _planCount = 0;
    std::size_t _planBytes = 0;
    std::size_t _controlCount = 0;                 ///< In both classes.
    std::array<std::size_t, CLASSES> _postponed{}; ///< How often another class was preferred.

public:
    explicit InputQueue(const InputLimits& limits);

    /// Queues the input, or merges it into one that waits. False: its class is full, and the input is unchanged. The receipt
    /// is that of a command.
    [[nodiscard]] bool TryPush(EngineInput& input, std::optional<CommandReceipt> receiptOrNull = std::nullopt);
    /// Only if not empty.
    [[nodiscard]] Next Pop();
    /// The timer was cancelled or restarted: if it has expired before, it is removed.
    void Remove(const EngineTimer& timer);
    /// Removes all inputs. Returns the commands among them, except acknowledgements.
    [[nodiscard]] std::vector<PlanCommand> Clear();
    [[nodiscard]] bool IsEmpty() const noexcept;
    [[nodiscard]] std::size_t GetCount() const noexcept;

private:
    [[nodiscard]] bool TryPushCommand(PlanCommand& command, std::optional<CommandReceipt> receiptOrNull);
    [[nodiscard]] bool TryPushPlan(PlanCommand& command);
    [[nodiscard]] bool TryPushControl(PlanCommand& command, std::optional<CommandReceipt> receiptOrNull);
    void PushRobot(RobotInput input);
    /// Into a waiting event, without a loss: the engine decides on nothing that differs between them.
    [[nodiscard]] static bool TryMerge(const RobotInputs& waiting, const RobotEvent& event);
    /// Drops what a newer event makes obsolete.
    [[nodiscard]] bool TryReplace(RobotInputs& waiting, const RobotEvent& event);
    /// Blocks a place, pauses the TSC, or takes a robot out of service.
    [[nodiscard]] static bool IsStop(const PlanCommand& command);
    [[nodiscard]] EClass ChooseClass();
    [[nodiscard]] Next PopUrgent();
    [[nodiscard]] Commands PopPlans();
};

} // namespace ACS::Planning
