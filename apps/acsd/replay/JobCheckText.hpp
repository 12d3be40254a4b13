#pragma once

#include "replay/CoreRecord.hpp"
#include <acs/core/Result.hpp>

#include <string>

namespace ACS::Acsd
{

/// What the job check of a robot has answered.
struct JobRejection
{
    std::string robotID;
    std::string job; ///< A text of EncodeJob.
    std::string reason;
};

[[nodiscard]] CoreRecord EncodeRejection(const JobRejection& rejection);

/// Reads what EncodeRejection wrote. Accepts any record.
[[nodiscard]] Core::Result<JobRejection> DecodeRejection(const CoreRecord& record);

} // namespace ACS::Acsd
