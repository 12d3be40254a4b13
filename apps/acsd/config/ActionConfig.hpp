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

/// How an action is done, according to one table of the configuration. An absent member is inherited from the more general
/// table.
struct MethodKeys
{
    std::optional<std::string> vehicleAction;
    std::optional<std::vector<VehicleParameter>> parameters;
    std::optional<std::uint32_t> armProgram;
    std::optional<std::vector<ArmInputTemplate>> armInputs;

    [[nodiscard]] bool IsOfVehicle() const noexcept;
    [[nodiscard]] bool IsOfArm() const noexcept;
    /// Name of the first key that is given; one of them is.
    [[nodiscard]] std::string FindFirstKey() const;
};

/// Reads `robot`, `timeout`, `from`, `to` and `effect`. Places and effect of an action of MCS-ACS are fixed.
[[nodiscard]] Planning::ActionRule ReadActionRule(const Apps::ConfigSection& section, const std::string& name);

/// Reads `vehicle_action`, `parameters`, `arm_program` and `arm_inputs`. Keys of both vehicle and arm are an error.
[[nodiscard]] MethodKeys ReadMethodKeys(
    const Apps::ConfigSection& section,
    const Planning::ActionRule& rule,
    const TemplateCheck& check);

/// Replaces the keys that `by` has. A key of a vehicle replaces all keys of an arm, and vice versa.
void ReplaceKeys(MethodKeys& keys, const MethodKeys& by);

[[nodiscard]] JobMethod MakeMethod(const MethodKeys& keys, const Planning::ActionRule& rule, std::size_t portCount);

} // namespace ACS::Acsd
