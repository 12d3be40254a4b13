#pragma once

#include "robots/ArmControls.hpp"
#include "robots/ArmInput.hpp"
#include <acs/openstream/ClientSessionActions.hpp>

#include <cstdint>
#include <optional>

namespace ACS::Acsd
{

/// The CONTROLs of a job's program: their URLs and bodies, and what is known of the controller that decides which are sent.
class ArmProgramControls
{
    enum class EReset : std::uint8_t
    {
        RCode,     ///< From version 60.30.
        TaskReset, ///< Earlier versions.
    };

    ArmControls& _controls;
    bool _bRewindDue = false;                   ///< A program was started or stopped since the program counter was set.
    EReset _sentReset = EReset::RCode;          ///< The latest.
    std::optional<EReset> _acceptedResetOrNull; ///< Of this connection.

public:
    /// The controls must outlive it.
    explicit ArmProgramControls(ArmControls& controls);

    void Select(std::uint32_t program);
    void Rewind();
    void WriteInput(const ArmInput& input);
    void Start();
    void Stop();
    void Resume();
    void Reset();
    /// After a refused reset: sends the one of the other versions. Returns false when the controller's reset is known, or
    /// both were refused.
    [[nodiscard]] bool TryOtherReset();

    /// The reset that was sent last was not refused.
    void OnResetVerified() noexcept;

    /// One of these has settled.
    void OnSettled(EArmControl kind, OpenStream::EControlOutcome outcome);
    void OnLost() noexcept;

    /// A selection may be refused until the program counter is set.
    [[nodiscard]] bool IsRewindDue() const noexcept;
    /// Whether the controller refused a selection because of its program counter.
    [[nodiscard]] static bool IsRewindWanted(const ArmRefusal& refusal) noexcept;

private:
    void SendReset(EReset reset);
};

} // namespace ACS::Acsd
