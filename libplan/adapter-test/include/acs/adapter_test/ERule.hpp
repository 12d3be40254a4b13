#pragma once

#include <acs/core/Api.hpp>

#include <array>
#include <cstdint>
#include <string_view>

namespace ACS::AdapterTest
{

/// A rule of the contract of IRobotAdapter. docs/guide/write-an-adapter.md lists them by name.
enum class ERule : std::uint8_t
{
    OutputInCall,
    SilentAfterDestruction,
    TimeAdvances,
    ConstantAnswers,
    LinkReported,
    StateAfterConnection,
    StateTrue,
    Usable,
    LoadsTrue,
    HeldNodes,
    RestartEvidenceTrue,
    KnownIDs,
    LateCommandsIgnored,
    OneEnd,
    NothingKept,
    CommandsKept,
    DriveAnswered,
    NodesInOrder,
    ReleasedNodesOnly,
    ArrivalTrue,
    CancelStops,
    JobAnswered,
    JobOnce,
    OutcomeTrue,
    RecoveryStartsNothing,
    CancelJobAnswered,
    PauseObeyed,
    ResumeObeyed,
    ChargingReported,
};

/// Every rule, in the order of the page.
inline constexpr std::array<ERule, 29> ALL_RULES{
    ERule::OutputInCall,
    ERule::SilentAfterDestruction,
    ERule::TimeAdvances,
    ERule::ConstantAnswers,
    ERule::LinkReported,
    ERule::StateAfterConnection,
    ERule::StateTrue,
    ERule::Usable,
    ERule::LoadsTrue,
    ERule::HeldNodes,
    ERule::RestartEvidenceTrue,
    ERule::KnownIDs,
    ERule::LateCommandsIgnored,
    ERule::OneEnd,
    ERule::NothingKept,
    ERule::CommandsKept,
    ERule::DriveAnswered,
    ERule::NodesInOrder,
    ERule::ReleasedNodesOnly,
    ERule::ArrivalTrue,
    ERule::CancelStops,
    ERule::JobAnswered,
    ERule::JobOnce,
    ERule::OutcomeTrue,
    ERule::RecoveryStartsNothing,
    ERule::CancelJobAnswered,
    ERule::PauseObeyed,
    ERule::ResumeObeyed,
    ERule::ChargingReported,
};

/// The name on the page: "job-once".
[[nodiscard]] ACS_API std::string_view GetRuleName(ERule rule);

/// What the contract demands, in a sentence.
[[nodiscard]] ACS_API std::string_view GetRuleText(ERule rule);

} // namespace ACS::AdapterTest
