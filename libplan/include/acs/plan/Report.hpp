#pragma once

#include <acs/core/Now.hpp>
#include <acs/plan/EAlarmLevel.hpp>
#include <acs/plan/EJobState.hpp>
#include <acs/plan/EPlanControl.hpp>
#include <acs/plan/EPlanState.hpp>
#include <acs/plan/EStepState.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>

namespace ACS::Planning
{

/// A state of a plan (section 6.12 of MCS-ACS).
struct PlanReport
{
    std::string planID;
    EPlanState state = EPlanState::Pending;
    std::string message;

    bool operator==(const PlanReport&) const = default;
};

/// A state of a step (section 6.13).
struct StepReport
{
    std::string planID;
    std::string robotID;
    std::int32_t stepNo = 0;
    EStepState state = EStepState::Pending;
    std::string message;

    bool operator==(const StepReport&) const = default;
};

/// A state of a job (section 6.14).
struct JobReport
{
    std::string planID;
    std::string robotID;
    std::int32_t stepNo = 0;
    std::string jobID;
    EJobState state = EJobState::Pending;
    std::string message;

    bool operator==(const JobReport&) const = default;
};

/// An alarm, identified by robotID, errorCode, planID and jobID; of the last three members those without a value do not apply.
/// The report that clears it repeats the content of the report that set it.
struct Alarm
{
    std::string robotID;                    ///< As RobotOptions::robotID, or "ACS" for an alarm of the engine itself.
    std::string errorCode;                  ///< "ACS-1008", or as RobotError::errorCode of a robot.
    EAlarmLevel level = EAlarmLevel::Light; ///< Heavy: something waits until the cause is removed.
    std::string message;                    ///< For the operator.
    std::optional<std::string> planID;
    std::optional<std::int32_t> stepNo;
    std::optional<std::string> jobID;
    /// The code with which it was reported to the MCS, and is cleared there; see EngineOptions::mcsCodes.
    std::optional<std::string> mcsCode = std::nullopt;

    /// Whether both have the same identity; level, message, stepNo and mcsCode may differ.
    [[nodiscard]] bool IsSameAs(const Alarm& other) const noexcept
    {
        return robotID == other.robotID && errorCode == other.errorCode && planID == other.planID
            && jobID == other.jobID;
    }

    bool operator==(const Alarm&) const = default;
};

/// An alarm was set or cleared (section 6.15).
struct ErrorReport
{
    Alarm alarm;
    bool bSet = true; ///< false: cleared.

    bool operator==(const ErrorReport&) const = default;
};

/// The outcome of CancelPlan, AbortPlan, PausePlan or ResumePlan (sections 6.5.A to 6.8.A).
struct ControlResultReport
{
    EPlanControl control = EPlanControl::Cancel;
    std::string planID;
    bool bSucceeded = false;
    std::string message;

    bool operator==(const ControlResultReport&) const = default;
};

/// A durable report: reaches the MCS in the order of creation, also after a restart.
using Report = std::variant<PlanReport, StepReport, JobReport, ErrorReport, ControlResultReport>;

/// A report with its transactionID and creation time, which are the same in every replay.
struct OutboxEntry
{
    std::uint64_t sequence = 0; ///< Ascending, from 1; never used twice in a store.
    std::string transactionID;  ///< A UUID; the same in every replay.
    Core::WallTime time;        ///< When the report was created.
    Report report;              ///< What is sent to the MCS.

    bool operator==(const OutboxEntry&) const = default;
};

/// Number and age of the reports that wait for their acknowledgement.
struct OutboxSummary
{
    std::size_t count = 0;                ///< Number of reports.
    std::optional<Core::WallTime> oldest; ///< Creation time of the oldest one; nullopt if none waits.
};

} // namespace ACS::Planning
