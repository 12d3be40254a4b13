#include "view/ActionViews.hpp"

#include "view/AgeText.hpp"
#include "view/DisplayText.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <string_view>

namespace ACS::Acsctl
{

namespace
{

EStyle GetActionStyle(std::string_view status)
{
    if (status == "Failed")
    {
        return EStyle::Bad;
    }
    return status == "Unknown" ? EStyle::Warning : EStyle::Plain;
}

/// "x=NUMBER mapId=STRING [mapHash=STRING]"
std::string MakeParameterList(const ActionOfferInfo& offer)
{
    std::string text;
    for (const ActionParameterInfo& parameter : offer.parameters)
    {
        text.append(text.empty() ? "" : " ");
        text += parameter.bRequired ? fmt::format("{}={}", parameter.key, parameter.valueType)
                                    : fmt::format("[{}={}]", parameter.key, parameter.valueType);
    }
    return text;
}

} // namespace

std::string PrintActions(const ActionsAnswer& answer, const ViewContext& context)
{
    constexpr std::size_t RESULT = 16;
    std::string out;
    if (answer.actions.empty())
    {
        out = "No instant action was requested.\n";
    }
    else
    {
        TextTable table({{"ACTION", 1}, {"STATUS", 0}, {"AGE", 0, 4, true}, {"RESULT", 2, RESULT}, {"ID", 3}});
        for (const ActionInfo& action : answer.actions)
        {
            table.AddRow(
                {{action.actionType},
                 {action.status, GetActionStyle(action.status)},
                 {MakeAge(action.requestedAt, context.now)},
                 {action.resultDescription},
                 {action.actionID}});
        }
        out = table.Print(context.screen);
    }
    if (answer.offered.empty())
    {
        return out + "\nThe robot offers none.\n";
    }
    TextTable offers({{"OFFERED", 1}, {"PARAMETERS", 2}, {"DESCRIPTION", 3}});
    for (const ActionOfferInfo& offer : answer.offered)
    {
        offers.AddRow({{offer.actionType}, {MakeParameterList(offer)}, {offer.description}});
    }
    return out + "\n" + offers.Print(context.screen);
}

std::string MakeOutcomeLine(const std::string& robotID, const ActionInfo& action)
{
    const std::string line = fmt::format("{} of {}: {}", action.actionType, robotID, action.status);
    return MakeDisplayable(action.resultDescription.empty() ? line : line + ": " + action.resultDescription) + "\n";
}

} // namespace ACS::Acsctl
