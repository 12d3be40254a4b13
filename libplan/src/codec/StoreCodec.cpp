#include <acs/json/TextCodec.hpp>
#include <acs/plan/StoreCodec.hpp>
#include <acs/plan_json/PlanFields.hpp>

namespace ACS::Planning
{

std::string EncodePlan(const Plan& plan)
{
    return Json::EncodeText(plan);
}

Core::Result<Plan> DecodePlan(std::string_view text)
{
    return Json::DecodeText<Plan>(text);
}

std::string EncodeProgress(const PlanProgress& progress)
{
    return Json::EncodeText(progress);
}

Core::Result<PlanProgress> DecodeProgress(std::string_view text)
{
    return Json::DecodeText<PlanProgress>(text);
}

std::string EncodeReport(const Report& report)
{
    return Json::EncodeText(report);
}

Core::Result<Report> DecodeReport(std::string_view text)
{
    return Json::DecodeText<Report>(text);
}

std::string EncodeCarriers(const CarriersChanged& carriers)
{
    return Json::EncodeText(carriers);
}

Core::Result<CarriersChanged> DecodeCarriers(std::string_view text)
{
    return Json::DecodeText<CarriersChanged>(text);
}

std::string EncodeRobotWork(const RobotWorkChanged& work)
{
    return Json::EncodeText(work);
}

Core::Result<RobotWorkChanged> DecodeRobotWork(std::string_view text)
{
    return Json::DecodeText<RobotWorkChanged>(text);
}

std::string EncodeAlarm(const Alarm& alarm)
{
    return Json::EncodeText(alarm);
}

Core::Result<Alarm> DecodeAlarm(std::string_view text)
{
    return Json::DecodeText<Alarm>(text);
}

std::string EncodeBlock(const Block& block)
{
    return Json::EncodeText(block);
}

Core::Result<Block> DecodeBlock(std::string_view text)
{
    return Json::DecodeText<Block>(text);
}

} // namespace ACS::Planning
