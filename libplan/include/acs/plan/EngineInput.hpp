#pragma once

#include <acs/plan/EngineAction.hpp>
#include <acs/plan/PlanCommand.hpp>
#include <acs/plan/RobotEvent.hpp>
#include <acs/plan/StoreLog.hpp>

#include <cstddef>
#include <cstdint>
#include <string>
#include <variant>

namespace ACS::Planning
{

/// An event of a robot's adapter.
struct RobotInput
{
    std::string robotID;
    RobotEvent event; ///< What the adapter has raised.
};

/// An input of the engine.
using EngineInput = std::variant<PlanCommand, RobotInput, EngineTimer, StoreLog>;

/// Maximum number of inputs that wait for the store. A command beyond a limit is refused. Events, timers and
/// acknowledgements are never refused; those that a later one replaces do not wait twice.
struct InputLimits
{
    std::size_t plans = 1'000;                   ///< SubmitPlan.
    std::size_t planBytes = 64U * 1024U * 1024U; ///< Of the plans; a single plan may exceed it.
    std::size_t controls = 256;                  ///< ControlPlan.
    std::size_t operatorCommands = 1'000;        ///< All other commands.
    /// Events of one robot. Beyond it, a state replaces the state before it, even if other members than pose and battery have
    /// changed, and a connection that ends before the engine has seen it is not passed to the engine.
    std::size_t robotEvents = 16;
};

/// What PlanEngineHost::Offer did with a command.
enum class EInputAdmission : std::uint8_t
{
    Accepted, ///< It is handled in its turn.
    Full,     ///< InputLimits. Repeat it later.
    Closed    ///< After PlanEngineHost::Close.
};

} // namespace ACS::Planning
