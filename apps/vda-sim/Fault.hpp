#pragma once

#include "common/faults/FaultBase.hpp"
#include "common/faults/FaultBoard.hpp"
#include "common/faults/FaultGrammar.hpp"
#include <acs/core/Now.hpp>
#include <acs/vda5050/StateMessage.hpp>
#include <acs/vda5050/Topic.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VdaSim
{

/// Faults of a virtual vehicle.
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

/// Direction of the messages that a fault affects, seen from the vehicle.
enum class EFaultDirection : std::uint8_t
{
    In,
    Out,
    Both,
};

/// One fault with its parameters; docs/reference/vda-sim.md has the table of kinds. The place is a node.
struct Fault : Apps::FaultBase<EFaultKind>
{
    // Each applies to the kinds that have it.
    bool bWill = true;
    std::optional<VDA5050::ETopic> topic; ///< Absent: every topic.
    EFaultDirection direction = EFaultDirection::Both;
    double percent = 100.0;
    Core::Duration hold{};   ///< Delay: of each message.
    Core::Duration jitter{}; ///< Delay: maximum random addition.
    double swerve = 0.0;     ///< Blocked: m beside the route that the vehicle needs to pass; 0: it cannot pass.
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

using FaultBoard = Apps::FaultBoard<Fault>;
using FaultChange = Apps::FaultChange<Fault>;
using FaultChanges = std::vector<FaultChange>;

/// Grammar of the faults of a vehicle.
[[nodiscard]] const Apps::FaultGrammar<Fault>& GetFaultGrammar();

/// "stuck", "action-fails", …
[[nodiscard]] std::string_view GetFaultName(EFaultKind kind);

} // namespace ACS::VdaSim
