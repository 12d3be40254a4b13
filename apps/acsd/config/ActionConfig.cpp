#include "config/ActionConfig.hpp"

#include "mcs/MessageValue.hpp"
#include "robots/DefaultParameters.hpp"

#include <fmt/format.h>
#include <tl/expected.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <string_view>
#include <utility>
#include <variant>

namespace ACS::Acsd
{

namespace
{

using namespace std::chrono_literals;
using Apps::ConfigSection;
using Planning::EActionEffect;
using Planning::EPlaceRule;

constexpr std::int64_t HIGHEST_PROGRAM = 9999;

EPlaceRule ReadPlaceRule(const ConfigSection& section, const std::string& key)
{
    static constexpr std::array<std::pair<std::string_view, EPlaceRule>, 6> RULES{
        {{"none", EPlaceRule::None},
         {"fixed_cp", EPlaceRule::FixedCassette},
         {"fixed_tp", EPlaceRule::FixedTray},
         {"robot_cp", EPlaceRule::RobotCassette},
         {"robot_tp", EPlaceRule::RobotTray},
         {"mp", EPlaceRule::Memory}}};
    const std::string word =
        section.GetWord(key, {"none", "fixed_cp", "fixed_tp", "robot_cp", "robot_tp", "mp"}, "none");
    for (const auto& [name, rule] : RULES)
    {
        if (word == name)
        {
            return rule;
        }
    }
    return EPlaceRule::None;
}

EActionEffect ReadEffect(const ConfigSection& section)
{
    const std::string word = section.GetWord("effect", {"load", "unload", "move", "none"}, "none");
    if (word == "load")
    {
        return EActionEffect::Load;
    }
    if (word == "unload")
    {
        return EActionEffect::Unload;
    }
    return word == "move" ? EActionEffect::Move : EActionEffect::None;
}

bool IsRobotPort(EPlaceRule rule)
{
    return rule == EPlaceRule::RobotCassette || rule == EPlaceRule::RobotTray;
}

void CheckEffect(const ConfigSection& section, const Planning::ActionRule& rule)
{
    if (rule.effect == EActionEffect::Load && !IsRobotPort(rule.to))
    {
        section.AddError("effect", R"(load needs to = "robot_cp" or "robot_tp")");
    }
    else if (rule.effect == EActionEffect::Unload && !IsRobotPort(rule.from))
    {
        section.AddError("effect", R"(unload needs from = "robot_cp" or "robot_tp")");
    }
    else if (rule.effect == EActionEffect::Move && !IsRobotPort(rule.from) && !IsRobotPort(rule.to))
    {
        section.AddError("effect", R"(move needs from or to as "robot_cp" or "robot_tp")");
    }
}

std::vector<VehicleParameter> ReadParameters(
    const ConfigSection& section,
    const Planning::ActionRule& rule,
    const TemplateCheck& check)
{
    std::vector<VehicleParameter> parameters;
    for (const std::string& key : section.GetNames())
    {
        if (const std::optional<std::string> fault = FindNameFaultOrNull(key))
        {
            section.AddError(key, *fault);
        }
        tl::expected<ParameterTemplate, std::string> value = ParameterTemplate::Make(*section.FindValueOrNull(key));
        if (!value.has_value())
        {
            section.AddError(key, value.error());
            continue;
        }
        for (const JobName& name : value->GetNames())
        {
            if (const std::optional<std::string> fault = check.FindFaultOrNull(name, rule))
            {
                section.AddError(key, *fault);
            }
        }
        parameters.push_back({key, std::move(*value), false});
    }
    return parameters;
}

tl::expected<NumberTemplate, std::string> MakeNumber(const toml::node& node)
{
    if (const std::optional<std::int64_t> number = node.value_exact<std::int64_t>())
    {
        return NumberTemplate(*number);
    }
    if (const std::optional<std::string> text = node.value_exact<std::string>())
    {
        return NumberTemplate::Parse(*text);
    }
    return tl::unexpected(std::string(R"(expected a whole number or exactly one name, such as "{from.cp}")"));
}

std::vector<ArmInputTemplate> ReadArmInputs(
    const ConfigSection& section,
    const Planning::ActionRule& rule,
    const TemplateCheck& check)
{
    std::vector<ArmInputTemplate> inputs;
    for (const std::string& key : section.GetNames())
    {
        tl::expected<NumberTemplate, std::string> value = MakeNumber(*section.FindValueOrNull(key));
        tl::expected<ArmRelay, std::string> relay = ParseArmRelay(key, check.GetRelayIndex());
        if (!relay.has_value() || !value.has_value())
        {
            section.AddError(key, relay.has_value() ? value.error() : relay.error());
            continue;
        }
        const auto overlapped = std::ranges::find_if(inputs, [&relay](const ArmInputTemplate& input) {
            return IsOverlapping(input.relay, *relay);
        });
        if (overlapped != inputs.end())
        {
            section.AddError(key, fmt::format("shares bytes with {}; see arm.relay_index", overlapped->relay.name));
        }
        inputs.push_back({std::move(*relay), std::move(*value)});
        if (const std::optional<std::string> fault = check.FindFaultOrNull(inputs.back(), rule))
        {
            section.AddError(key, *fault);
        }
    }
    return inputs;
}

} // namespace

bool MethodKeys::IsOfVehicle() const noexcept
{
    return vehicleAction.has_value() || parameters.has_value();
}

bool MethodKeys::IsOfArm() const noexcept
{
    return armProgram.has_value() || armInputs.has_value();
}

std::string MethodKeys::FindFirstKey() const
{
    if (IsOfArm())
    {
        return armProgram.has_value() ? "arm_program" : "arm_inputs";
    }
    return vehicleAction.has_value() ? "vehicle_action" : "parameters";
}

Planning::ActionRule ReadActionRule(const ConfigSection& section, const std::string& name)
{
    const Planning::ActionTable standard = Planning::MakeStandardActions();
    const auto known = standard.find(name);
    Planning::ActionRule rule = known == standard.end() ? Planning::ActionRule{} : known->second;
    rule.robotType =
        section.GetWord("robot", {"LR", "CR"}) == "CR" ? Planning::ERobotType::CR : Planning::ERobotType::LR;
    rule.timeout = section.GetDuration("timeout", 0ms, 24h, rule.timeout);
    if (known == standard.end())
    {
        rule.from = ReadPlaceRule(section, "from");
        rule.to = ReadPlaceRule(section, "to");
        rule.effect = ReadEffect(section);
        rule.bJobsRequired = rule.from != EPlaceRule::None || rule.to != EPlaceRule::None;
        CheckEffect(section, rule);
        return rule;
    }
    for (const std::string key : {"from", "to", "effect"})
    {
        if (section.HasKey(key))
        {
            section.AddError(key, "MCS-ACS fixes it for this action; give it for actions of your own");
        }
    }
    return rule;
}

MethodKeys ReadMethodKeys(const ConfigSection& section, const Planning::ActionRule& rule, const TemplateCheck& check)
{
    MethodKeys keys;
    if (section.HasKey("vehicle_action"))
    {
        keys.vehicleAction = section.GetString("vehicle_action");
        if (keys.vehicleAction->empty())
        {
            section.AddError("vehicle_action", "is empty; give a VDA5050 actionType");
        }
        else if (const std::optional<std::string> fault = FindNameFaultOrNull(*keys.vehicleAction))
        {
            section.AddError("vehicle_action", *fault);
        }
    }
    if (section.HasKey("parameters"))
    {
        keys.parameters = ReadParameters(section.GetSection("parameters"), rule, check);
    }
    if (section.HasKey("arm_program"))
    {
        keys.armProgram = static_cast<std::uint32_t>(section.GetInteger("arm_program", 1, HIGHEST_PROGRAM));
    }
    if (section.HasKey("arm_inputs"))
    {
        keys.armInputs = ReadArmInputs(section.GetSection("arm_inputs"), rule, check);
    }
    if (keys.IsOfVehicle() && keys.IsOfArm())
    {
        section.AddError(
            "",
            "has keys of a vehicle (vehicle_action, parameters) and of an arm (arm_program, arm_inputs); give those of one");
    }
    return keys;
}

void ReplaceKeys(MethodKeys& keys, const MethodKeys& by)
{
    const bool bOtherKind = (by.IsOfVehicle() && keys.IsOfArm()) || (by.IsOfArm() && keys.IsOfVehicle());
    if (bOtherKind)
    {
        keys = {};
    }
    keys.vehicleAction = by.vehicleAction.has_value() ? by.vehicleAction : keys.vehicleAction;
    keys.parameters = by.parameters.has_value() ? by.parameters : keys.parameters;
    keys.armProgram = by.armProgram.has_value() ? by.armProgram : keys.armProgram;
    keys.armInputs = by.armInputs.has_value() ? by.armInputs : keys.armInputs;
}

JobMethod MakeMethod(const MethodKeys& keys, const Planning::ActionRule& rule, std::size_t portCount)
{
    JobMethod method;
    method.effect = rule.effect;
    method.vehicleAction = keys.vehicleAction.value_or(std::string());
    if (!method.vehicleAction.empty())
    {
        method.parameters = keys.parameters.has_value() ? *keys.parameters
                                                        : MakeDefaultParameters(method.vehicleAction, rule, portCount);
    }
    method.armProgram = keys.armProgram.value_or(0);
    method.armInputs = keys.armInputs.value_or(std::vector<ArmInputTemplate>());
    return method;
}

} // namespace ACS::Acsd
