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

/// Writes a plan, for PlanRecord::plan. The functions of this header write and read the JSON texts of a store on disk. They are
/// not the messages of MCS-ACS, although a plan looks alike. Decoders accept any text, because a stored file may be damaged: an
/// invalid one is an error of ACS::Core::ECoreError.
[[nodiscard]] ACS_API std::string EncodePlan(const Plan& plan);
/// Reads what EncodePlan wrote, also a plan of an older version.
[[nodiscard]] ACS_API Core::Result<Plan> DecodePlan(std::string_view text);

/// Writes the changing part of a plan record.
[[nodiscard]] ACS_API std::string EncodeProgress(const PlanProgress& progress);
/// Reads what EncodeProgress wrote.
[[nodiscard]] ACS_API Core::Result<PlanProgress> DecodeProgress(std::string_view text);

/// Writes a durable report with its kind.
[[nodiscard]] ACS_API std::string EncodeReport(const Report& report);
/// Reads what EncodeReport wrote.
[[nodiscard]] ACS_API Core::Result<Report> DecodeReport(std::string_view text);

/// Writes the record of a robot's ports.
[[nodiscard]] ACS_API std::string EncodeCarriers(const CarriersChanged& carriers);
/// Reads what EncodeCarriers wrote.
[[nodiscard]] ACS_API Core::Result<CarriersChanged> DecodeCarriers(std::string_view text);

/// Writes the commands of a robot.
[[nodiscard]] ACS_API std::string EncodeRobotWork(const RobotWorkChanged& work);
/// Reads what EncodeRobotWork wrote.
[[nodiscard]] ACS_API Core::Result<RobotWorkChanged> DecodeRobotWork(std::string_view text);

/// Writes an alarm that is set.
[[nodiscard]] ACS_API std::string EncodeAlarm(const Alarm& alarm);
/// Reads what EncodeAlarm wrote.
[[nodiscard]] ACS_API Core::Result<Alarm> DecodeAlarm(std::string_view text);

/// Writes a block.
[[nodiscard]] ACS_API std::string EncodeBlock(const Block& block);
/// Reads what EncodeBlock wrote.
[[nodiscard]] ACS_API Core::Result<Block> DecodeBlock(std::string_view text);

} // namespace ACS::Planning
