#pragma once

#include "common/config/ConfigSection.hpp"
#include "config/TemplateCheck.hpp"
#include "robots/JobMethod.hpp"
#include <acs/plan/EngineOptions.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// What one table of the configuration says of how an action is done. What is absent is as the table before it says.
struct MethodKeys
{
    std::optional<std::string> vehicleAction;
    std::optional<std::vector<VehicleParameter>> parameters;
    std::optional<std::uint32_t> armProgram;
    std::optional<std::vector<ArmInputTemplate>> armInputs;

    [[nodiscard]] bool IsOfVehicle() const noexcept;
    [[nodiscard]] bool IsOfArm() const noexcept;
};

/// Reads `robot`, `timeout`, `from`, `to` and `effect`. An action of the document keeps its places and its effect.
[[nodiscard]] Planning::ActionRule ReadActionRule(const Apps::ConfigSection& section, const std::string& name);

/// Reads `vehicle_action`, `parameters`, `arm_program` and `arm_inputs`: keys of the vehicle or of the arm, never both.
[[nodiscard]] MethodKeys ReadMethodKeys(
    const Apps::ConfigSection& section,
    const Planning::ActionRule& rule,
    const TemplateCheck& check);

/// Replaces the keys that the other one has. One of a vehicle replaces all keys of an arm, and the other way round.
void ReplaceKeys(MethodKeys& keys, const MethodKeys& by);

[[nodiscard]] JobMethod MakeMethod(const MethodKeys& keys, const Planning::ActionRule& rule, std::size_t portCount);

} // namespace ACS::Acsd
