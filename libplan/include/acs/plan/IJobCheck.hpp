#pragma once

#include <acs/core/Api.hpp>
#include <acs/plan/RobotCommand.hpp>

#include <optional>
#include <string>

namespace ACS::Planning
{

/// Checks whether a robot can execute a job, with what its adapter knows before the job is commanded. Immutable: when that
/// changes, the adapter raises JobCheckChanged with a new object.
class ACS_API IJobCheck
{
public:
    IJobCheck() = default;
    IJobCheck(const IJobCheck&) = delete;
    IJobCheck& operator=(const IJobCheck&) = delete;
    virtual ~IJobCheck() = default;

    /// Why the robot cannot execute the job, in a sentence for the MCS; nullopt if it can. The job has no commandID,
    /// progressToken and jobNumber yet, and no jobID if its step has no job in the plan.
    [[nodiscard]] virtual std::optional<std::string> GetRejectionReasonOrNull(const StartJob& job) const = 0;
};

} // namespace ACS::Planning
