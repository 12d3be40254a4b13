#include "replay/OutputText.hpp"

#include "replay/RecordKind.hpp"
#include "replay/SessionEventCodec.hpp"
#include "replay/StateCodec.hpp"
#include <acs/core/JsonText.hpp>
#include <acs/core/Overloaded.hpp>
#include <acs/plan/StoreCodec.hpp>
#include <acs/protocol/AcsCodec.hpp>

#include <fmt/format.h>

#include <cstdint>
#include <utility>
#include <variant>

namespace ACS::Acsd
{

namespace
{

/// The same on every machine (FNV-1a).
std::uint64_t MakeHash(std::string_view text)
{
    std::uint64_t hash = 0xCBF29CE484222325U;
    for (const char byte : text)
    {
        hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001B3U;
    }
    return hash;
}

std::string QuoteID(std::string_view text)
{
    std::string quoted;
    Core::JsonText::AppendString(text, quoted);
    return quoted;
}

std::string DescribeJob(const Planning::StartJob& job)
{
    Planning::RobotWorkChanged work; // the codec of the store writes a job as part of it
    work.job = job;
    return Planning::EncodeRobotWork(work);
}

std::string DescribeRoute(const Planning::Route& route)
{
    std::string text = "[";
    for (std::size_t i = 0; i < route.nodes.size(); ++i)
    {
        text += i == 0 ? "" : ",";
        Core::JsonText::AppendString(route.nodes[i].nodeID, text);
        if (i < route.edges.size())
        {
            text += ',';
            Core::JsonText::AppendString(route.edges[i].edgeID, text);
        }
    }
    return text + "]";
}

std::string DescribeRobotCommand(const Planning::RobotCommand& command)
{
    using namespace Planning; // NOLINT(google-build-using-namespace): all alternatives of a variant
    return std::visit(
        Core::Overloaded{
            [](const Drive& drive) {
                return fmt::format(
                    R"({{"command":"Drive","driveId":{},"released":{},"route":{}}})",
                    QuoteID(drive.driveID),
                    drive.releasedCount,
                    DescribeRoute(drive.route));
            },
            [](const ExtendDrive& extend) {
                return fmt::format(
                    R"({{"command":"ExtendDrive","driveId":{},"released":{}}})",
                    QuoteID(extend.driveID),
                    extend.releasedCount);
            },
            [](const CancelDrive& cancel) {
                return fmt::format(R"({{"command":"CancelDrive","driveId":{}}})", QuoteID(cancel.driveID));
            },
            [](const StartJob& job) { return fmt::format(R"({{"command":"StartJob","work":{}}})", DescribeJob(job)); },
            [](const RecoverJob& recover) {
                return fmt::format(
                    R"({{"command":"RecoverJob","earlierIds":{},"work":{}}})",
                    recover.earlierIDs.size(),
                    DescribeJob(recover.job));
            },
            [](const CancelJob& cancel) {
                return fmt::format(R"({{"command":"CancelJob","jobId":{}}})", QuoteID(cancel.jobID));
            },
            [](const Pause&) { return std::string(R"({"command":"Pause"})"); },
            [](const Resume&) { return std::string(R"({"command":"Resume"})"); },
            [](const StartCharging&) { return std::string(R"({"command":"StartCharging"})"); },
            [](const StopCharging&) { return std::string(R"({"command":"StopCharging"})"); },
            [](const auto& /*of a later version*/) {
                return std::string(R"({"command":"other"})");
            }},
        command);
}

} // namespace

CoreRecord EncodeRequest(std::string_view kind, const Protocol::AcsRequest& request)
{
    CoreRecord record;
    record.kind = kind;
    Protocol::AcsCodec::EncodeRequest(request, record.text);
    record.robotID = FindRobotID(request.payload);
    record.planID = FindPlanID(request.payload);
    record.transactionID = request.transactionID;
    if (std::holds_alternative<Protocol::RobotPositionUpdate>(request.payload))
    {
        record.text = fmt::format(R"({{"hash":"{:016x}"}})", MakeHash(record.text));
    }
    return record;
}

CoreRecord EncodeAnswer(const Protocol::AcsAck& ack)
{
    CoreRecord record;
    record.kind = "answer";
    Protocol::AcsCodec::EncodeAck(ack, record.text);
    if (const auto* const planOrNull = std::get_if<Protocol::PlanAck>(&ack.payload))
    {
        record.planID = planOrNull->planID;
    }
    record.transactionID = ack.transactionID;
    return record;
}

CoreRecord EncodeRobotCommand(const Planning::CommandRobot& command)
{
    CoreRecord record;
    record.kind = COMMAND_KIND;
    record.robotID = command.robotID;
    record.text = DescribeRobotCommand(command.command);
    if (const auto* const jobOrNull = std::get_if<Planning::StartJob>(&command.command))
    {
        record.planID = jobOrNull->planID;
    }
    return record;
}

CoreRecord EncodeTransaction(const Planning::StoreBatch& batch)
{
    CoreRecord record;
    record.kind = "store";
    record.planID = FindPlanID(batch);
    record.text = EncodeBatch(batch);
    return record;
}

std::string EncodeJob(const Planning::StartJob& job)
{
    return DescribeJob(job);
}

} // namespace ACS::Acsd
