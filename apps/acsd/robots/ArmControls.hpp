#pragma once

#include "robots/ArmAnswers.hpp"
#include "robots/RobotOutputs.hpp"
#include <acs/openstream/ClientSessionActions.hpp>

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::Acsd
{

/// What a CONTROL is for.
enum class EArmControl : std::uint8_t
{
    SwitchMotorOn,
    SelectProgram,
    RewindProgram, ///< Sets the program counter, without which a controller may refuse a selection.
    WriteInput,
    StartProgram,
    StopProgram,   ///< For a pause.
    ResumeProgram, ///< Starts it again where it was stopped.
    ResetProgram,  ///< Abandons it where it was stopped.
};

/// A controller's refusal of a CONTROL.
struct ArmRefusal
{
    std::string reason; ///< For people.
    int status = 0;     ///< HTTP.
    std::optional<std::int64_t> codeOrNull;
};

[[nodiscard]] ArmRefusal MakeArmRefusal(
    int status,
    const std::optional<Core::JsonText>& bodyOrNull,
    const std::string& detail);

/// A CONTROL whose outcome is known.
struct ArmSettlement
{
    EArmControl kind = EArmControl::SwitchMotorOn;
    OpenStream::EControlOutcome outcome = OpenStream::EControlOutcome::Unknown;
    ArmRefusal refusal; ///< Where it was refused.
};

/// The tracked CONTROLs of one arm: they settle in the order in which they were sent.
class ArmControls
{
    RobotOutputs& _outputs;
    std::deque<EArmControl> _unsettled;

public:
    explicit ArmControls(RobotOutputs& outputs);

    void Send(EArmControl kind, std::string_view url, std::string body);
    /// Nullopt for one that was not sent here.
    [[nodiscard]] std::optional<ArmSettlement> SettleOrNull(const OpenStream::ClientControlSettled& settled);
    [[nodiscard]] bool IsIdle() const noexcept;
};

} // namespace ACS::Acsd
