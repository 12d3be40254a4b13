#pragma once

#include <acs/core/Api.hpp>
#include <acs/core/Result.hpp>
#include <acs/plan/IPlanStore.hpp>
#include <acs/plan/Plan.hpp>
#include <acs/plan/PlanRecord.hpp>
#include <acs/plan/Report.hpp>

#include <string>
#include <string_view>

namespace ACS::Planning
{

/// The JSON texts in a store on disk. They are not the messages of MCS-ACS, although a plan looks alike. Decoders accept any
/// text, because a stored file may be damaged: an invalid one is an error of ACS::Core::ECoreError.
[[nodiscard]] ACS_API std::string EncodePlan(const Plan& plan);
[[nodiscard]] ACS_API Core::Result<Plan> DecodePlan(std::string_view text);

[[nodiscard]] ACS_API std::string EncodeProgress(const PlanProgress& progress);
[[nodiscard]] ACS_API Core::Result<PlanProgress> DecodeProgress(std::string_view text);

[[nodiscard]] ACS_API std::string EncodeReport(const Report& report);
[[nodiscard]] ACS_API Core::Result<Report> DecodeReport(std::string_view text);

[[nodiscard]] ACS_API std::string EncodeCarriers(const CarriersChanged& carriers);
[[nodiscard]] ACS_API Core::Result<CarriersChanged> DecodeCarriers(std::string_view text);

[[nodiscard]] ACS_API std::string EncodeRobotWork(const RobotWorkChanged& work);
[[nodiscard]] ACS_API Core::Result<RobotWorkChanged> DecodeRobotWork(std::string_view text);

[[nodiscard]] ACS_API std::string EncodeAlarm(const Alarm& alarm);
[[nodiscard]] ACS_API Core::Result<Alarm> DecodeAlarm(std::string_view text);

} // namespace ACS::Planning
