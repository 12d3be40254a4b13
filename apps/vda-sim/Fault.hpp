#pragma once

#include <acs/core/Now.hpp>
#include <acs/core/Result.hpp>
#include <acs/vda5050/StateMessage.hpp>
#include <acs/vda5050/Topic.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ACS::VdaSim
{

/// What can go wrong with a virtual vehicle on command.
enum class EFaultKind : std::uint8_t
{
    Drop,
    Silence,
    Stuck,
    Blocked,
    Lost,
    ActionFails,
    EmergencyStop,
    Mode,
    Battery,
    Refuse,
    Loss,
    Delay,
};

/// Which messages a fault is about, as the vehicle sees them.
enum class EFaultDirection : std::uint8_t
{
    In,
    Out,
    Both,
};

/// One fault with its parameters; docs/vda-sim.md has the table of kinds. Times are of the wall clock, not scaled.
struct Fault
{
    EFaultKind kind = EFaultKind::Drop;
    std::string text; ///< As it was written, blanks made one: what the log says.

    // When.
    Core::Duration delay{};               ///< Until it begins: after the start, or after the node was reached.
    std::string nodeID;                   ///< Not empty: begins once the vehicle has reached this node.
    std::optional<Core::Duration> lasts;  ///< Absent: until it is ended, or used up.
    std::optional<std::uint32_t> maxUses; ///< ActionFails, Refuse: how many; absent: one, or while it lasts.

    // What, each for the kinds that have it.
    bool bWill = true;
    std::optional<VDA5050::ETopic> topic; ///< Absent: every topic.
    EFaultDirection direction = EFaultDirection::Both;
    double percent = 100.0;
    Core::Duration hold{};   ///< Delay: of each message.
    Core::Duration jitter{}; ///< Delay: up to this much more.
    double swerve = 0.0;     ///< Blocked: m that the vehicle has to leave its way to pass; 0: it cannot.
    std::string actionType;  ///< ActionFails: empty: any.
    std::string actionID;
    bool bAtStart = false;
    VDA5050::EEmergencyStop emergencyStop = VDA5050::EEmergencyStop::Manual;
    VDA5050::EOperatingMode mode = VDA5050::EOperatingMode::Manual;
    double charge = 10.0; ///< %
    std::string errorType;
    VDA5050::EErrorLevel errorLevel = VDA5050::EErrorLevel::Warning;

    bool operator==(const Fault&) const = default;
};

/// "stuck", "action-fails", …
[[nodiscard]] std::string_view GetFaultName(EFaultKind kind);

/// Fails with ECoreError::UnknownWord, and the names that there are.
[[nodiscard]] Core::Result<EFaultKind> ParseFaultKind(std::string_view name);

/// "stuck at=10s for=5s". Fails with ECoreError::UnknownWord or OutOfRange: the path is the parameter.
[[nodiscard]] Core::Result<Fault> ParseFault(std::string_view text);

/// A line for each kind: its name, its parameters, what it does. For --help.
[[nodiscard]] std::string MakeFaultHelp();

} // namespace ACS::VdaSim
