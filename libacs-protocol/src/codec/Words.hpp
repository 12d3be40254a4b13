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
    using Word = EnumWord<Protocol::EAcsCommand>;
    using E = Protocol::EAcsCommand;
    static constexpr std::array WORDS{
        Word{E::ExecutionPlan, "ExecutionPlan"},
        Word{E::CancelPlan, "CancelPlan"},
        Word{E::AbortPlan, "AbortPlan"},
        Word{E::PausePlan, "PausePlan"},
        Word{E::ResumePlan, "ResumePlan"},
        Word{E::SyncConfig, "SyncConfig"},
        Word{E::RequestAcsPlans, "RequestAcsPlans"},
        Word{E::RequestAcsPlanHistory, "RequestAcsPlanHistory"},
        Word{E::RequestAcsErrorList, "RequestAcsErrorList"},
        Word{E::Registration, "Registration"},
        Word{E::TscStateUpdate, "TscStateUpdate"},
        Word{E::AcsCommStateUpdate, "AcsCommStateUpdate"},
        Word{E::PlanReport, "PlanReport"},
        Word{E::StepReport, "StepReport"},
        Word{E::JobReport, "JobReport"},
        Word{E::CancelResultReport, "CancelResultReport"},
        Word{E::AbortResultReport, "AbortResultReport"},
        Word{E::PauseResultReport, "PauseResultReport"},
        Word{E::ResumeResultReport, "ResumeResultReport"},
        Word{E::ErrorReport, "ErrorReport"},
        Word{E::RobotStatusUpdate, "RobotStatusUpdate"},
        Word{E::RobotPositionUpdate, "RobotPositionUpdate"},
    };
    static_assert(WORDS.size() == Protocol::COMMAND_COUNT);
};

template <>
struct EnumNames<Protocol::EAckResult>
{
    static constexpr std::array WORDS{
        EnumWord<Protocol::EAckResult>{Protocol::EAckResult::Success, "Success"},
        EnumWord<Protocol::EAckResult>{Protocol::EAckResult::Fail, "Fail"},
    };
};

template <>
struct EnumNames<Protocol::EReportResult>
{
    static constexpr std::array WORDS{
        EnumWord<Protocol::EReportResult>{Protocol::EReportResult::Success, "Success"},
        EnumWord<Protocol::EReportResult>{Protocol::EReportResult::Failed, "Failed"},
        EnumWord<Protocol::EReportResult>{Protocol::EReportResult::Fail, "Fail"},
    };
};

template <>
struct EnumNames<Protocol::EPlanStatus>
{
    using Word = EnumWord<Protocol::EPlanStatus>;
    using E = Protocol::EPlanStatus;
    static constexpr std::array WORDS{
        Word{E::Pending, "Pending"},
        Word{E::InProgress, "InProgress"},
        Word{E::Paused, "Paused"},
        Word{E::Completed, "Completed"},
        Word{E::Failed, "Failed"},
        Word{E::Cancelled, "Cancelled"},
        Word{E::Aborted, "Aborted"},
    };
};

template <>
struct EnumNames<Protocol::EStepStatus>
{
    using Word = EnumWord<Protocol::EStepStatus>;
    using E = Protocol::EStepStatus;
    static constexpr std::array WORDS{
        Word{E::Pending, "Pending"},
        Word{E::Dispatched, "Dispatched"},
        Word{E::InProgress, "InProgress"},
        Word{E::Completed, "Completed"},
        Word{E::Failed, "Failed"},
        Word{E::Skipped, "Skipped"},
    };
};

template <>
struct EnumNames<Protocol::EJobStatus>
{
    using Word = EnumWord<Protocol::EJobStatus>;
    using E = Protocol::EJobStatus;
    static constexpr std::array WORDS{
        Word{E::Pending, "Pending"},
        Word{E::Instructed, "Instructed"},
        Word{E::InProgress, "InProgress"},
        Word{E::Completed, "Completed"},
        Word{E::Failed, "Failed"},
    };
};

template <>
struct EnumNames<Protocol::EErrorLevel>
{
    static constexpr std::array WORDS{
        EnumWord<Protocol::EErrorLevel>{Protocol::EErrorLevel::Heavy, "heavy"},
        EnumWord<Protocol::EErrorLevel>{Protocol::EErrorLevel::Light, "light"},
    };
};

template <>
struct EnumNames<Protocol::ERobotType>
{
    static constexpr std::array WORDS{
        EnumWord<Protocol::ERobotType>{Protocol::ERobotType::Logistics, "LR"},
        EnumWord<Protocol::ERobotType>{Protocol::ERobotType::Control, "CR"},
    };
};

template <>
struct EnumNames<Protocol::ERobotStatus>
{
    using Word = EnumWord<Protocol::ERobotStatus>;
    using E = Protocol::ERobotStatus;
    static constexpr std::array WORDS{
        Word{E::Init, "Init"},
        Word{E::Disconnected, "Disconnected"},
        Word{E::Manual, "Manual"},
        Word{E::Idle, "Idle"},
        Word{E::Moving, "Moving"},
        Word{E::Arrival, "Arrival"},
        Word{E::Docking, "Docking"},
        Word{E::UnDocking, "UnDocking"},
        Word{E::Working, "Working"},
        Word{E::Charging, "Charging"},
        Word{E::Error, "Error"},
        Word{E::Stopped, "Stopped"},
    };
};

template <>
struct EnumNames<Protocol::ETscState>
{
    static constexpr std::array WORDS{
        EnumWord<Protocol::ETscState>{Protocol::ETscState::Auto, "Auto"},
        EnumWord<Protocol::ETscState>{Protocol::ETscState::Paused, "Paused"},
        EnumWord<Protocol::ETscState>{Protocol::ETscState::Pausing, "Pausing"},
    };
};

/// Not of the wire: for logs and metrics.
template <>
struct EnumNames<Protocol::EProtocolNote>
{
    using Word = EnumWord<Protocol::EProtocolNote>;
    using E = Protocol::EProtocolNote;
    static constexpr std::array WORDS{
        Word{E::UnknownMember, "unknown member"},
        Word{E::NullOptional, "null for an absent member"},
        Word{E::LenientWord, "word in another case"},
        Word{E::LenientNumber, "number in a string"},
        Word{E::BadTimestamp, "bad timestamp"},
        Word{E::Undecodable, "undecodable text"},
        Word{E::UnknownCommand, "unsupported command"},
        Word{E::AckMismatched, "ack with a foreign transactionId"},
        Word{E::AckUnexpected, "unexpected ack"},
        Word{E::AckFailed, "status refused"},
        Word{E::DuplicateRequest, "repeated request"},
        Word{E::BeforeRegistered, "message before registration"},
        Word{E::RegistrationUnanswered, "unanswered registration"},
    };
    static_assert(WORDS.size() == Protocol::NOTE_COUNT);
};

} // namespace ACS::Json
