#include "robots/MethodResolver.hpp"

#include "robots/ArmRelay.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string_view>

namespace ACS::Acsd
{

namespace
{

constexpr const char* ARM_INPUTS = "arm_inputs";
constexpr std::size_t METHOD_WORD_BYTES = 4;

/// The part of a URL of val_s32 that names the relays: "m", "fb0_do".
std::string_view GetArea(std::string_view url)
{
    constexpr std::string_view PREFIX = "/project/plc/";
    if (!url.starts_with(PREFIX))
    {
        return url;
    }
    url.remove_prefix(PREFIX.size());
    return url.substr(0, url.find('/'));
}

/// The first byte of the counter or echo that shares a byte with the relay.
std::optional<std::size_t> FindCounterOrNull(const ArmRelay& relay, const ArmOptions& options)
{
    if (GetArea(relay.url) != GetArea(options.monitorURL))
    {
        return std::nullopt;
    }
    std::vector<std::size_t> words{options.startedIndex, options.finishedIndex, options.failedIndex};
    if (options.echoIndex.has_value())
    {
        words.push_back(*options.echoIndex);
    }
    for (const std::size_t word : words)
    {
        ArmRelay counter;
        counter.url = relay.url;
        counter.width = EArmRelayWidth::Long;
        counter.firstByte = static_cast<std::uint32_t>(options.firstByte + word * METHOD_WORD_BYTES);
        if (IsOverlapping(relay, counter))
        {
            return counter.firstByte;
        }
    }
    return std::nullopt;
}

/// Why the robot cannot do the action by the method: a method of a vehicle for a robot with an arm, or vice versa. The cause
/// is in `given`, the table that was read last.
std::optional<MethodFault> FindMethodFaultOrNull(
    const std::string& action,
    const JobMethod& method,
    const MethodKeys& given,
    const VehicleConfig& vehicle)
{
    if (given.IsOfVehicle() == given.IsOfArm())
    {
        return std::nullopt; // keys of both or of neither are reported already
    }
    const bool bArm = vehicle.armOrNull.has_value();
    if (bArm && method.armProgram == 0)
    {
        return MethodFault{
            vehicle.robotID,
            given.FindFirstKey(),
            fmt::format("the arm has no program for {}", action),
            fmt::format("give arm_program, because {} has an arm", vehicle.robotID)};
    }
    if (!bArm && method.vehicleAction.empty())
    {
        return MethodFault{
            vehicle.robotID,
            given.FindFirstKey(),
            fmt::format("the vehicle has no action for {}", action),
            fmt::format("give vehicle_action, because {} has no arm", vehicle.robotID)};
    }
    return std::nullopt;
}

/// Otherwise the input would overwrite the counter, or acsd would read the input as the counter.
void RefuseCounters(const MethodTable& table, const VehicleConfig& vehicle)
{
    if (!vehicle.armOrNull.has_value() || !table.keys.armInputs.has_value())
    {
        return;
    }
    for (const ArmInputTemplate& input : *table.keys.armInputs)
    {
        if (const std::optional<std::size_t> counter = FindCounterOrNull(input.relay, vehicle.armOptions))
        {
            table.section.GetSection(ARM_INPUTS)
                .AddError(
                    input.relay.name,
                    fmt::format(
                        "this relay holds a job counter of the arm of {} (bytes {} to {}); choose another one",
                        vehicle.robotID,
                        *counter,
                        *counter + METHOD_WORD_BYTES - 1));
        }
    }
}

/// Its program cannot echo a number that it does not receive.
void WarnWithoutNumber(const MethodTable& table, const VehicleConfig& vehicle, std::vector<std::string>& warnings)
{
    if (!table.keys.armInputs.has_value() || table.keys.armInputs->empty() || !vehicle.armOptions.echoIndex.has_value())
    {
        return;
    }
    const bool bNumbered = std::ranges::any_of(*table.keys.armInputs, [](const ArmInputTemplate& input) {
        const JobName* const nameOrNull = input.value.GetNameOrNull();
        return nameOrNull != nullptr && nameOrNull->subject == JobName::ESubject::JobNumber;
    });
    std::string warning = fmt::format(
        "{}.arm_inputs: has no {{job_number}}, so its program cannot echo it: every change of the counters counts for the job. "
        "Add it, or set arm.counter_echo = -1 if no program of the arm can echo it",
        table.section.GetPath());
    if (!bNumbered && std::ranges::find(warnings, warning) == warnings.end())
    {
        warnings.push_back(std::move(warning));
    }
}

/// A table of a station applies to robots that do the action in the same way: by the vehicle, or by the arm.
bool IsSameKind(const MethodKeys& keys, const MethodKeys& by)
{
    return (by.IsOfVehicle() && keys.IsOfVehicle()) || (by.IsOfArm() && keys.IsOfArm());
}

} // namespace

MethodResolver::MethodResolver(
    const std::string& action,
    const Planning::ActionRule& rule,
    const MethodTable& base,
    const StationTables& stations,
    std::vector<std::string>& warnings)
    : _action(action),
      _rule(rule),
      _base(base),
      _stations(stations),
      _warnings(warnings)
{
}

void MethodResolver::SetMethods(const MethodTable* overrideOrNull, VehicleConfig& vehicle)
{
    MethodKeys keys = _base.keys;
    if (overrideOrNull != nullptr)
    {
        ReplaceKeys(keys, overrideOrNull->keys);
    }
    const MethodTable& given = overrideOrNull == nullptr ? _base : *overrideOrNull;
    const std::optional<MethodFault> fault =
        FindMethodFaultOrNull(_action, MakeMethod(keys, _rule, vehicle.portCount), given.keys, vehicle);
    if (fault.has_value() && overrideOrNull != nullptr)
    {
        _bOverrideFault = true;
        given.section.AddError(
            fault->key,
            fmt::format("{} cannot do {} with it: {}; {}", vehicle.robotID, _action, fault->reason, fault->remedy));
    }
    else if (fault.has_value() && !_baseFaultOrNull.has_value())
    {
        _baseFaultOrNull = fault;
    }
    else if (!fault.has_value())
    {
        _used.push_back(keys);
    }
    const bool bOwnInputs = overrideOrNull != nullptr && overrideOrNull->keys.armInputs.has_value();
    const MethodTable& inputs = bOwnInputs ? *overrideOrNull : _base;
    RefuseCounters(inputs, vehicle);
    if (keys.IsOfArm())
    {
        WarnWithoutNumber(inputs, vehicle, _warnings);
    }
    vehicle.methods.SetMethod(_action, {}, MakeMethod(keys, _rule, vehicle.portCount));
    SetStationMethods(keys, vehicle);
}

void MethodResolver::Check(const SitePlaces& places) const
{
    const bool bBaseValid = _base.keys.vehicleAction.has_value() != _base.keys.armProgram.has_value();
    if (bBaseValid && _used.empty() && _baseFaultOrNull.has_value() && !_bOverrideFault)
    {
        _base.section.AddError(
            _baseFaultOrNull->key,
            fmt::format(
                "no robot can do it, {}: {}; {}",
                _baseFaultOrNull->robotID,
                _baseFaultOrNull->reason,
                _baseFaultOrNull->remedy));
    }
    for (const auto& [stationID, tables] : _stations)
    {
        const auto table = tables.find(_action);
        if (table != tables.end())
        {
            CheckStation(stationID, table->second, places);
        }
    }
}

void MethodResolver::SetStationMethods(const MethodKeys& keys, VehicleConfig& vehicle) const
{
    for (const auto& [stationID, tables] : _stations)
    {
        const auto table = tables.find(_action);
        if (table == tables.end() || !IsSameKind(keys, table->second.keys))
        {
            continue;
        }
        MethodKeys atStation = keys;
        ReplaceKeys(atStation, table->second.keys);
        RefuseCounters(table->second, vehicle);
        WarnWithoutNumber(table->second, vehicle, _warnings);
        vehicle.methods.SetMethod(_action, stationID, MakeMethod(atStation, _rule, vehicle.portCount));
    }
}

void MethodResolver::CheckStation(const std::string& stationID, const MethodTable& table, const SitePlaces& places)
    const
{
    const bool bUsed =
        std::ranges::any_of(_used, [&table](const MethodKeys& keys) { return IsSameKind(keys, table.keys); });
    const bool bOfBase = IsSameKind(_base.keys, table.keys);
    if (!places.HasPlaceAt(stationID, _rule))
    {
        table.section.AddError("", fmt::format("has no effect: {} has no job at this station", _action));
    }
    else if (!bUsed && !bOfBase)
    {
        table.section.AddError(
            "",
            fmt::format("expected keys of the same kind as in actions.{}: of a vehicle or of an arm", _action));
    }
    else if (!bUsed && !_used.empty() && !_bOverrideFault)
    {
        table.section.AddError(
            "",
            fmt::format(
                "has no effect: no robot does {} with {}",
                _action,
                table.keys.IsOfArm() ? "an arm" : "its vehicle"));
    }
}

} // namespace ACS::Acsd
