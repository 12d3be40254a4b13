#pragma once

#include <acs/core/Result.hpp>
#include <acs/plan/IPlanStore.hpp>
#include <acs/plan/Plan.hpp>
#include <acs/plan/PlanRecord.hpp>
#include <acs/plan/Report.hpp>

#include <string>
#include <string_view>

namespace ACS::Planning
{

/// The JSON texts in which a store on disk keeps things. Reading is total: stored bytes come from outside too. The wire's
/// messages are another matter, though plans look alike.
[[nodiscard]] std::string EncodePlan(const Plan& plan);
[[nodiscard]] Core::Result<Plan> DecodePlan(std::string_view text);

[[nodiscard]] std::string EncodeProgress(const PlanProgress& progress);
[[nodiscard]] Core::Result<PlanProgress> DecodeProgress(std::string_view text);

[[nodiscard]] std::string EncodeReport(const Report& report);
[[nodiscard]] Core::Result<Report> DecodeReport(std::string_view text);

[[nodiscard]] std::string EncodeCarriers(const CarriersChanged& carriers);
[[nodiscard]] Core::Result<CarriersChanged> DecodeCarriers(std::string_view text);

[[nodiscard]] std::string EncodeRobotWork(const RobotWorkChanged& work);
[[nodiscard]] Core::Result<RobotWorkChanged> DecodeRobotWork(std::string_view text);

[[nodiscard]] std::string EncodeAlarm(const Alarm& alarm);
[[nodiscard]] Core::Result<Alarm> DecodeAlarm(std::string_view text);

} // namespace ACS::Planning
