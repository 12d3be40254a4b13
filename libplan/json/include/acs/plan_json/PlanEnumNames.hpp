#pragma once

#include <acs/json/EnumNames.hpp>
#include <acs/plan/EAlarmLevel.hpp>
#include <acs/plan/EBlockKind.hpp>
#include <acs/plan/EControlOrigin.hpp>
#include <acs/plan/EJobResolution.hpp>
#include <acs/plan/EJobState.hpp>
#include <acs/plan/EPlanControl.hpp>
#include <acs/plan/EPlanState.hpp>
#include <acs/plan/ERobotStatus.hpp>
#include <acs/plan/ERobotType.hpp>
#include <acs/plan/EStepState.hpp>
#include <acs/plan/ETscState.hpp>

#include <array>

namespace ACS::Json
{

// The words of section 3 of MCS-ACS: for logs, texts and the store.

template <>
struct EnumNames<Planning::EPlanState>
{
    static constexpr std::array WORDS{
        EnumWord<Planning::EPlanState>{Planning::EPlanState::Pending, "Pending"},
        EnumWord<Planning::EPlanState>{Planning::EPlanState::InProgress, "InProgress"},
        EnumWord<Planning::EPlanState>{Planning::EPlanState::Paused, "Paused"},
        EnumWord<Planning::EPlanState>{Planning::EPlanState::Completed, "Completed"},
        EnumWord<Planning::EPlanState>{Planning::EPlanState::Failed, "Failed"},
        EnumWord<Planning::EPlanState>{Planning::EPlanState::Cancelled, "Cancelled"},
        EnumWord<Planning::EPlanState>{Planning::EPlanState::Aborted, "Aborted"},
    };
};

template <>
struct EnumNames<Planning::EStepState>
{
    static constexpr std::array WORDS{
        EnumWord<Planning::EStepState>{Planning::EStepState::Pending, "Pending"},
        EnumWord<Planning::EStepState>{Planning::EStepState::Dispatched, "Dispatched"},
        EnumWord<Planning::EStepState>{Planning::EStepState::InProgress, "InProgress"},
        EnumWord<Planning::EStepState>{Planning::EStepState::Completed, "Completed"},
        EnumWord<Planning::EStepState>{Planning::EStepState::Failed, "Failed"},
        EnumWord<Planning::EStepState>{Planning::EStepState::Skipped, "Skipped"},
    };
};

template <>
struct EnumNames<Planning::EJobState>
{
    static constexpr std::array WORDS{
        EnumWord<Planning::EJobState>{Planning::EJobState::Pending, "Pending"},
        EnumWord<Planning::EJobState>{Planning::EJobState::Instructed, "Instructed"},
        EnumWord<Planning::EJobState>{Planning::EJobState::InProgress, "InProgress"},
        EnumWord<Planning::EJobState>{Planning::EJobState::Completed, "Completed"},
        EnumWord<Planning::EJobState>{Planning::EJobState::Failed, "Failed"},
    };
};

template <>
struct EnumNames<Planning::EJobResolution>
{
    static constexpr std::array WORDS{
        EnumWord<Planning::EJobResolution>{Planning::EJobResolution::Done, "Done"},
        EnumWord<Planning::EJobResolution>{Planning::EJobResolution::Failed, "Failed"},
        EnumWord<Planning::EJobResolution>{Planning::EJobResolution::Again, "Again"},
    };
};

template <>
struct EnumNames<Planning::ERobotType>
{
    static constexpr std::array WORDS{
        EnumWord<Planning::ERobotType>{Planning::ERobotType::LR, "LR"},
        EnumWord<Planning::ERobotType>{Planning::ERobotType::CR, "CR"},
    };
};

template <>
struct EnumNames<Planning::ERobotStatus>
{
    static constexpr std::array WORDS{
        EnumWord<Planning::ERobotStatus>{Planning::ERobotStatus::Init, "Init"},
        EnumWord<Planning::ERobotStatus>{Planning::ERobotStatus::Disconnected, "Disconnected"},
        EnumWord<Planning::ERobotStatus>{Planning::ERobotStatus::Manual, "Manual"},
        EnumWord<Planning::ERobotStatus>{Planning::ERobotStatus::Idle, "Idle"},
        EnumWord<Planning::ERobotStatus>{Planning::ERobotStatus::Moving, "Moving"},
        EnumWord<Planning::ERobotStatus>{Planning::ERobotStatus::Arrival, "Arrival"},
        EnumWord<Planning::ERobotStatus>{Planning::ERobotStatus::Docking, "Docking"},
        EnumWord<Planning::ERobotStatus>{Planning::ERobotStatus::UnDocking, "UnDocking"},
        EnumWord<Planning::ERobotStatus>{Planning::ERobotStatus::Working, "Working"},
        EnumWord<Planning::ERobotStatus>{Planning::ERobotStatus::Charging, "Charging"},
        EnumWord<Planning::ERobotStatus>{Planning::ERobotStatus::Error, "Error"},
        EnumWord<Planning::ERobotStatus>{Planning::ERobotStatus::Stopped, "Stopped"},
    };
};

template <>
struct EnumNames<Planning::EAlarmLevel>
{
    static constexpr std::array WORDS{
        EnumWord<Planning::EAlarmLevel>{Planning::EAlarmLevel::Heavy, "heavy"},
        EnumWord<Planning::EAlarmLevel>{Planning::EAlarmLevel::Light, "light"},
    };
};

template <>
struct EnumNames<Planning::EPlanControl>
{
    static constexpr std::array WORDS{
        EnumWord<Planning::EPlanControl>{Planning::EPlanControl::Cancel, "Cancel"},
        EnumWord<Planning::EPlanControl>{Planning::EPlanControl::Abort, "Abort"},
        EnumWord<Planning::EPlanControl>{Planning::EPlanControl::Pause, "Pause"},
        EnumWord<Planning::EPlanControl>{Planning::EPlanControl::Resume, "Resume"},
    };
};

template <>
struct EnumNames<Planning::EControlOrigin>
{
    static constexpr std::array WORDS{
        EnumWord<Planning::EControlOrigin>{Planning::EControlOrigin::MCS, "MCS"},
        EnumWord<Planning::EControlOrigin>{Planning::EControlOrigin::Operator, "Operator"},
    };
};

template <>
struct EnumNames<Planning::EBlockKind>
{
    static constexpr std::array WORDS{
        EnumWord<Planning::EBlockKind>{Planning::EBlockKind::Node, "node"},
        EnumWord<Planning::EBlockKind>{Planning::EBlockKind::Edge, "edge"},
        EnumWord<Planning::EBlockKind>{Planning::EBlockKind::Station, "station"},
    };
};

template <>
struct EnumNames<Planning::ETscState>
{
    static constexpr std::array WORDS{
        EnumWord<Planning::ETscState>{Planning::ETscState::Auto, "Auto"},
        EnumWord<Planning::ETscState>{Planning::ETscState::Paused, "Paused"},
        EnumWord<Planning::ETscState>{Planning::ETscState::Pausing, "Pausing"},
    };
};

} // namespace ACS::Json
