#include "vda-sim/LoadHandling.hpp"

#include <acs/core/ParseNumber.hpp>
#include <acs/vda5050/PredefinedActions.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>
#include <utility>

namespace ACS::VdaSim
{
namespace
{

using VDA5050::EValueDataType;

constexpr std::size_t LOGISTICS_PORTS = 4;
constexpr std::size_t MAX_NAME = 64;

struct TypeWord
{
    std::string_view word;
    EValueDataType type;
};

/// Types that can express a place or a load.
constexpr std::array TYPE_WORDS{
    TypeWord{"STRING", EValueDataType::String},
    TypeWord{"NUMBER", EValueDataType::Number},
    TypeWord{"INTEGER", EValueDataType::Integer},
    TypeWord{"FLOAT", EValueDataType::Float}};

tl::unexpected<Core::Error> Refuse(std::string_view key, std::string expected, std::string_view found)
{
    return Core::Fail(Core::ECoreError::UnknownWord, std::string(key), std::move(expected), Core::QuoteForError(found));
}

bool IsName(std::string_view text)
{
    return !text.empty() && text.size() <= MAX_NAME
        && std::ranges::all_of(text, [](char letter) { return letter > ' ' && letter <= '~'; });
}

const VDA5050::AgvAction& GetPick()
{
    return *VDA5050::FindPredefinedActionOrNull(VDA5050::ActionTypes::PICK);
}

bool IsStandardParameter(std::string_view key)
{
    return std::ranges::find(GetPick().actionParameters, key, &VDA5050::AgvActionParameter::key)
        != GetPick().actionParameters.end();
}

Core::Result<bool> ReadPorts(std::string_view value, LoadHandling& handling)
{
    const std::optional<std::size_t> count = Core::ParseNumberOrNull<std::size_t>(value);
    if (!count.has_value() || *count > LoadHandling::MAX_PORTS)
    {
        return Refuse("ports", fmt::format("a number from 0 to {}", LoadHandling::MAX_PORTS), value);
    }
    handling.ports = *count;
    return true;
}

Core::Result<bool> ReadPosition(std::string_view value, LoadHandling& handling)
{
    const std::size_t colon = value.find(':');
    const std::string port(value.substr(0, colon));
    const std::string_view name = colon == std::string_view::npos ? std::string_view{} : value.substr(colon + 1);
    if (!IsName(port) || !IsName(name) || !handling.positions.emplace(port, name).second)
    {
        return Refuse("load", "PORT:NAME (CP01:front), each port once", value);
    }
    return true;
}

Core::Result<bool> ReadActionType(std::string_view key, std::string_view value, std::string& type)
{
    if (!IsName(value) || (value != key && VDA5050::FindPredefinedActionOrNull(value) != nullptr))
    {
        return Refuse(key, "an actionType without another meaning in the standard", value);
    }
    type = std::string(value);
    return true;
}

Core::Result<bool> ReadParameter(std::string_view key, std::string_view value, LoadHandling& handling)
{
    const std::size_t colon = value.find(':');
    ParameterForm form{std::string(value.substr(0, colon)), {}};
    if (colon != std::string_view::npos)
    {
        const auto* const word = std::ranges::find(TYPE_WORDS, value.substr(colon + 1), &TypeWord::word);
        if (word == TYPE_WORDS.end())
        {
            return Refuse(key, "STRING, NUMBER, INTEGER or FLOAT as its type", value.substr(colon + 1));
        }
        form.typeOrNull = word->type;
    }
    if (!IsName(form.name) && !value.empty())
    {
        return Refuse(key, "the vehicle's name of the parameter, or nothing if it is not supported", value);
    }
    handling.parameters.insert_or_assign(std::string(key), std::move(form));
    return true;
}

/// A key that changes pick or drop; empty: none does.
std::string FindChangedKey(const LoadHandling& handling)
{
    if (handling.pickType != VDA5050::ActionTypes::PICK)
    {
        return std::string(VDA5050::ActionTypes::PICK);
    }
    if (handling.dropType != VDA5050::ActionTypes::DROP)
    {
        return std::string(VDA5050::ActionTypes::DROP);
    }
    return handling.parameters.empty() ? std::string() : handling.parameters.begin()->first;
}

} // namespace

std::string_view LoadHandling::GetParameterName(std::string_view key) const
{
    const auto found = parameters.find(key);
    return found == parameters.end() ? key : found->second.name;
}

std::vector<LoadPosition> GetLoadPositions(EVehicleType type, const LoadHandling& handling)
{
    const std::size_t count = handling.ports.value_or(type == EVehicleType::Logistics ? LOGISTICS_PORTS : 0);
    std::vector<LoadPosition> positions;
    for (std::size_t number = 1; number <= count; ++number)
    {
        std::string port = fmt::format("CP{:02}", number);
        const auto named = handling.positions.find(port);
        std::string name = named == handling.positions.end() ? port : named->second;
        positions.push_back({std::move(port), std::move(name)});
    }
    return positions;
}

VDA5050::AgvAction AdaptAction(VDA5050::AgvAction action, const LoadHandling& handling)
{
    for (VDA5050::AgvActionParameter& parameter : action.actionParameters)
    {
        const auto form = handling.parameters.find(parameter.key);
        if (form != handling.parameters.end())
        {
            parameter.key = form->second.name;
            parameter.valueDataType = form->second.typeOrNull.value_or(parameter.valueDataType);
        }
    }
    std::erase_if(action.actionParameters, [](const VDA5050::AgvActionParameter& parameter) {
        return parameter.key.empty();
    });
    const bool bPick = action.actionType == VDA5050::ActionTypes::PICK;
    action.actionType = bPick ? handling.pickType : handling.dropType;
    return action;
}

Core::Result<bool> TryReadHandlingKey(std::string_view key, std::string_view value, LoadHandling& handling)
{
    if (key == "ports")
    {
        return ReadPorts(value, handling);
    }
    if (key == "load")
    {
        return ReadPosition(value, handling);
    }
    if (key == VDA5050::ActionTypes::PICK || key == VDA5050::ActionTypes::DROP)
    {
        return ReadActionType(key, value, key == VDA5050::ActionTypes::PICK ? handling.pickType : handling.dropType);
    }
    return IsStandardParameter(key) ? ReadParameter(key, value, handling) : Core::Result<bool>(false);
}

Core::Result<void> CheckHandling(EVehicleType type, const LoadHandling& handling)
{
    const std::vector<LoadPosition> positions = GetLoadPositions(type, handling);
    const std::string unused = positions.empty() ? FindChangedKey(handling) : std::string();
    if (!unused.empty())
    {
        return Core::Fail(
            Core::ECoreError::UnknownWord,
            unused,
            "ports=N too, because the vehicle has no load positions and neither picks nor drops");
    }
    std::set<std::string_view> names;
    for (const LoadPosition& position : positions)
    {
        if (!names.insert(position.name).second)
        {
            return Refuse("load", "a different name for each port", position.name);
        }
    }
    for (const auto& [port, name] : handling.positions)
    {
        if (std::ranges::find(positions, port, &LoadPosition::port) == positions.end())
        {
            return Refuse("load", fmt::format("one of the {} ports, CP01 and so on", positions.size()), port);
        }
    }
    if (handling.pickType == handling.dropType)
    {
        return Refuse("drop", "an actionType that differs from that of pick", handling.dropType);
    }
    std::set<std::string> keys;
    for (const VDA5050::AgvActionParameter& parameter : AdaptAction(GetPick(), handling).actionParameters)
    {
        if (!keys.insert(parameter.key).second)
        {
            return Refuse(parameter.key, "a different name for each parameter", parameter.key);
        }
    }
    return {};
}

} // namespace ACS::VdaSim
