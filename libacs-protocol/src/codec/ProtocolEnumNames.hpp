#pragma once

#include <acs/json/EnumNames.hpp>
#include <acs/protocol/AcsMessage.hpp>
#include <acs/protocol/SessionEvent.hpp>

#include <array>

// The one place that spells the protocol's words (section 3).
namespace ACS::Json
{

template <>
struct EnumNames<Protocol::EAcsCommand>
{
    using E = Protocol::EAcsCommand;
    static constexpr auto WORDS = std::to_array<EnumWord<E>>({
        {E::ExecutionPlan, "ExecutionPlan"},
        {E::CancelPlan, "CancelPlan"},
        {E::AbortPlan, "AbortPlan"},
        {E::PausePlan, "PausePlan"},
        {E::ResumePlan, "ResumePlan"},
        {E::SyncConfig, "SyncConfig"},
        {E::RequestAcsPlans, "RequestAcsPlans"},
        {E::RequestAcsPlanHistory, "RequestAcsPlanHistory"},
        {E::RequestAcsErrorList, "RequestAcsErrorList"},
        {E::Registration, "Registration"},
        {E::TscStateUpdate, "TscStateUpdate"},
        {E::AcsCommStateUpdate, "AcsCommStateUpdate"},
        {E::PlanReport, "PlanReport"},
        {E::StepReport, "StepReport"},
        {E::JobReport, "JobReport"},
        {E::CancelResultReport, "CancelResultReport"},
        {E::AbortResultReport, "AbortResultReport"},
        {E::PauseResultReport, "PauseResultReport"},
        {E::ResumeResultReport, "ResumeResultReport"},
        {E::ErrorReport, "ErrorReport"},
        {E::RobotStatusUpdate, "RobotStatusUpdate"},
        {E::RobotPositionUpdate, "RobotPositionUpdate"},
    });
    static_assert(WORDS.size() == Protocol::COMMAND_COUNT);
};

template <>
struct EnumNames<Protocol::EAckResult>
{
    using E = Protocol::EAckResult;
    static constexpr auto WORDS = std::to_array<EnumWord<E>>({
        {E::Success, "Success"},
        {E::Fail, "Fail"},
    });
};

template <>
struct EnumNames<Protocol::EReportResult>
{
    using E = Protocol::EReportResult;
    static constexpr auto WORDS = std::to_array<EnumWord<E>>({
        {E::Success, "Success"},
        {E::Failed, "Failed"},
        {E::Fail, "Fail"},
    });
};

template <>
struct EnumNames<Protocol::EPlanStatus>
{
    using E = Protocol::EPlanStatus;
    static constexpr auto WORDS = std::to_array<EnumWord<E>>({
        {E::Pending, "Pending"},
        {E::InProgress, "InProgress"},
        {E::Paused, "Paused"},
        {E::Completed, "Completed"},
        {E::Failed, "Failed"},
        {E::Cancelled, "Cancelled"},
        {E::Aborted, "Aborted"},
    });
};

template <>
struct EnumNames<Protocol::EStepStatus>
{
    using E = Protocol::EStepStatus;
    static constexpr auto WORDS = std::to_array<EnumWord<E>>({
        {E::Pending, "Pending"},
        {E::Dispatched, "Dispatched"},
        {E::InProgress, "InProgress"},
        {E::Completed, "Completed"},
        {E::Failed, "Failed"},
        {E::Skipped, "Skipped"},
    });
};

template <>
struct EnumNames<Protocol::EJobStatus>
{
    using E = Protocol::EJobStatus;
    static constexpr auto WORDS = std::to_array<EnumWord<E>>({
        {E::Pending, "Pending"},
        {E::Instructed, "Instructed"},
        {E::InProgress, "InProgress"},
        {E::Completed, "Completed"},
        {E::Failed, "Failed"},
    });
};

template <>
struct EnumNames<Protocol::EErrorLevel>
{
    using E = Protocol::EErrorLevel;
    static constexpr auto WORDS = std::to_array<EnumWord<E>>({
        {E::Heavy, "heavy"},
        {E::Light, "light"},
    });
};

template <>
struct EnumNames<Protocol::ERobotType>
{
    using E = Protocol::ERobotType;
    static constexpr auto WORDS = std::to_array<EnumWord<E>>({
        {E::Logistics, "LR"},
        {E::Control, "CR"},
    });
};

template <>
struct EnumNames<Protocol::ERobotStatus>
{
    using E = Protocol::ERobotStatus;
    static constexpr auto WORDS = std::to_array<EnumWord<E>>({
        {E::Init, "Init"},
        {E::Disconnected, "Disconnected"},
        {E::Manual, "Manual"},
        {E::Idle, "Idle"},
        {E::Moving, "Moving"},
        {E::Arrival, "Arrival"},
        {E::Docking, "Docking"},
        {E::UnDocking, "UnDocking"},
        {E::Working, "Working"},
        {E::Charging, "Charging"},
        {E::Error, "Error"},
        {E::Stopped, "Stopped"},
    });
};

template <>
struct EnumNames<Protocol::ETscState>
{
    using E = Protocol::ETscState;
    static constexpr auto WORDS = std::to_array<EnumWord<E>>({
        {E::Auto, "Auto"},
        {E::Paused, "Paused"},
        {E::Pausing, "Pausing"},
    });
};

/// Not of the wire: for logs and metrics.
template <>
struct EnumNames<Protocol::EProtocolNote>
{
    using E = Protocol::EProtocolNote;
    static constexpr auto WORDS = std::to_array<EnumWord<E>>({
        {E::UnknownMember, "unknown member"},
        {E::NullOptional, "null for an absent member"},
        {E::LenientWord, "word in another case"},
        {E::LenientNumber, "number in a string"},
        {E::BadTimestamp, "bad timestamp"},
        {E::Undecodable, "undecodable text"},
        {E::UnknownCommand, "unsupported command"},
        {E::AckMismatched, "ack with a foreign transactionId"},
        {E::AckUnexpected, "unexpected ack"},
        {E::AckFailed, "status refused"},
        {E::DuplicateRequest, "repeated request"},
        {E::BeforeRegistered, "message before registration"},
        {E::RegistrationUnanswered, "unanswered registration"},
    });
    static_assert(WORDS.size() == Protocol::NOTE_COUNT);
};

} // namespace ACS::Json
