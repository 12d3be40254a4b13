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

/// The JSON texts in a store on disk. They are not the messages of MCS-ACS, although a plan looks alike. Decoders accept any
/// text, because a stored file may be damaged: an invalid one is an error of ACS::Core::ECoreError.
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
