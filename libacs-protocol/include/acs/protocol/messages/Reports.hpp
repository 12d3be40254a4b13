#pragma once

#include <acs/core/Api.hpp>

#include <cstdint>
#include <string>
#include <string_view>

namespace ACS::Protocol
{

/// Section 6.12. Completed, Failed, Cancelled and Aborted are final.
enum class EPlanStatus : std::uint8_t
{
    Pending,
    InProgress,
    Paused,
    Completed,
    Failed,
    Cancelled,
    Aborted,
};

/// Whether the plan has ended.
[[nodiscard]] constexpr bool IsFinal(EPlanStatus status) noexcept
{
    return status == EPlanStatus::Completed || status == EPlanStatus::Failed || status == EPlanStatus::Cancelled
        || status == EPlanStatus::Aborted;
}

/// Section 6.13.
enum class EStepStatus : std::uint8_t
{
    Pending,
    Dispatched,
    InProgress,
    Completed,
    Failed,
    Skipped,
};

/// Section 6.14, without the two struck out there.
enum class EJobStatus : std::uint8_t
{
    Pending,
    Instructed,
    InProgress,
    Completed,
    Failed,
};

/// The name on the wire.
[[nodiscard]] ACS_API std::string_view GetText(EPlanStatus status);
/// The name on the wire.
[[nodiscard]] ACS_API std::string_view GetText(EStepStatus status);
/// The name on the wire.
[[nodiscard]] ACS_API std::string_view GetText(EJobStatus status);

/// ACS to MCS: the status of a plan changed (section 6.12).
struct PlanReport
{
    std::string planID;
    EPlanStatus status = EPlanStatus::Pending;
    std::string message;

    bool operator==(const PlanReport&) const = default;
};

/// ACS to MCS: the status of a step changed (section 6.13).
struct StepReport
{
    std::string planID;
    std::string robotID;
    std::int32_t stepNo = 0;
    EStepStatus status = EStepStatus::Pending;
    std::string message;

    bool operator==(const StepReport&) const = default;
};

/// ACS to MCS: the status of a job changed (section 6.14).
struct JobReport
{
    std::string planID;
    std::string robotID;
    std::int32_t stepNo = 0;
    std::string jobID;
    EJobStatus status = EJobStatus::Pending;
    std::string message;

    bool operator==(const JobReport&) const = default;
};

} // namespace ACS::Protocol
