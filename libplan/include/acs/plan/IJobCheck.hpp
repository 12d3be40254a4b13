#pragma once

#include <acs/plan/RobotCommand.hpp>

#include <optional>
#include <string>

namespace ACS::Planning
{

/// Which jobs a robot can do, as far as its adapter knows before they are commanded. Immutable: when the adapter learns
/// more, it raises JobCheckChanged with another one.
class IJobCheck
{
public:
    IJobCheck() = default;
    IJobCheck(const IJobCheck&) = delete;
    IJobCheck& operator=(const IJobCheck&) = delete;
    virtual ~IJobCheck() = default;

    /// Why the robot cannot do the job, in words for the MCS; nullopt where it can. The job has no commandID, progressToken and
    /// jobNumber yet, and no jobID where the plan gives its step no job.
    [[nodiscard]] virtual std::optional<std::string> GetRejectionReasonOrNull(const StartJob& job) const = 0;
};

} // namespace ACS::Planning
