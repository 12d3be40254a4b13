#pragma once

#include "transaction/EngineState.hpp"
#include <acs/plan/RobotEvent.hpp>

#include <cstddef>
#include <string_view>
#include <unordered_map>

namespace ACS::Planning
{

/// Sets and clears an alarm for each error that a robot reports. A robot may report any number of errors: beyond a limit, and
/// while the outbox has no more room for alarms, they are one alarm together (ACS-1014), which has their number. It has no data of its own: ErrorBudget has.
class ErrorWatch
{
public:
    static constexpr std::size_t MOST_ALARMS = 20; ///< Alarms of one robot about its errors, besides ACS-1014.

private:
    /// By code, the most severe one.
    using Errors = std::unordered_map<std::string_view, const RobotError*>;

    const OutboxRoom& _room;
    AlarmBook& _alarms;
    EngineTransaction& _transaction;

public:
    explicit ErrorWatch(EngineState& engine);

    /// Compares the reported errors with the alarms of the robot.
    void CompareErrors(Robot& robot);

private:
    /// Clears alarms without an error, and updates the others. Removes their errors from the list. Returns the number of alarms
    /// that are left.
    [[nodiscard]] std::size_t UpdateSet(const Robot& robot, Errors& errors);
    /// Sets, updates or clears ACS-1014.
    void UpdateSummary(Robot& robot, std::size_t count, bool bHeavy);
};

} // namespace ACS::Planning
