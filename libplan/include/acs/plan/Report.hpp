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

/// Section 5.4 of MCS-ACS.
struct PlanReport
{
    std::string planID;
    EPlanState state = EPlanState::Pending;
    std::string message;

    bool operator==(const PlanReport&) const = default;
};

/// Section 5.5.
struct StepReport
{
    std::string planID;
    std::string robotID;
    std::int32_t stepNo = 0;
    EStepState state = EStepState::Pending;
    std::string message;

    bool operator==(const StepReport&) const = default;
};

/// Section 5.6.
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

/// An alarm. Its identity is (robotID, errorCode, planID, jobID): the clearing report repeats what the setting one said.
struct Alarm
{
    std::string robotID;
    std::string errorCode;
    EAlarmLevel level = EAlarmLevel::Light;
    std::string message;
    std::optional<std::string> planID;
    std::optional<std::int32_t> stepNo;
    std::optional<std::string> jobID;

    [[nodiscard]] bool IsSameAs(const Alarm& other) const noexcept
    {
        return robotID == other.robotID && errorCode == other.errorCode && planID == other.planID
            && jobID == other.jobID;
    }

    bool operator==(const Alarm&) const = default;
};

/// Section 5.8.
struct ErrorReport
{
    Alarm alarm;
    bool bSet = true; ///< false: cleared.

    bool operator==(const ErrorReport&) const = default;
};

/// The real outcome of CancelPlan, AbortPlan, PausePlan or ResumePlan (section 5.7).
struct ControlResultReport
{
    EPlanControl control = EPlanControl::Cancel;
    std::string planID;
    bool bSucceeded = false;
    std::string message;

    bool operator==(const ControlResultReport&) const = default;
};

/// What must reach the MCS, in this order, even over restarts.
using Report = std::variant<PlanReport, StepReport, JobReport, ErrorReport, ControlResultReport>;

/// A report with what makes a repetition the same message: its transactionID and its first time.
struct OutboxEntry
{
    std::uint64_t sequence = 0; ///< The outbox id: ascending, from 1; never used twice for one store.
    std::string transactionID;
    Core::WallTime time;
    Report report;

    bool operator==(const OutboxEntry&) const = default;
};

/// How many reports wait for the MCS, and since when.
struct OutboxSummary
{
    std::size_t count = 0;
    std::optional<Core::WallTime> oldest; ///< When the oldest one was made; nullopt: none waits.
};

} // namespace ACS::Planning
