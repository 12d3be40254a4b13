#include "view/ActionCodec.hpp"

#include "view/ViewFields.hpp"

#include <tuple>
#include <vector>

namespace ACS::Json
{

template <>
struct ValueEncoder<Acsd::ERobotActionStatus>
{
    static void Encode(Acsd::ERobotActionStatus status, JsonWriter& writer)
    {
        writer.WritePlainString(GetText(status));
    }
};

/// An object with a member per parameter.
template <>
struct ValueEncoder<std::vector<Acsd::RobotActionParameter>>
{
    static void Encode(const std::vector<Acsd::RobotActionParameter>& parameters, JsonWriter& writer)
    {
        writer.BeginObject();
        for (const Acsd::RobotActionParameter& parameter : parameters)
        {
            writer.Key(parameter.key);
            writer.WriteRaw(parameter.value);
        }
        writer.EndObject();
    }
};

template <>
struct JsonFields<Acsd::RobotActionRecord>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("actionId", &Acsd::RobotActionRecord::actionID),
        Required("actionType", &Acsd::RobotActionRecord::actionType),
        Required("parameters", &Acsd::RobotActionRecord::parameters),
        Required("reason", &Acsd::RobotActionRecord::reason),
        Required("requestedAt", &Acsd::RobotActionRecord::requestedAt),
        Required("status", &Acsd::RobotActionRecord::status),
        Required("resultDescription", &Acsd::RobotActionRecord::resultDescription),
        Nullable("endedAt", &Acsd::RobotActionRecord::endedAt));
};

template <>
struct JsonFields<Acsd::RobotParameterOffer>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("key", &Acsd::RobotParameterOffer::key),
        Required("valueType", &Acsd::RobotParameterOffer::valueType),
        Required("required", &Acsd::RobotParameterOffer::bRequired));
};

template <>
struct JsonFields<Acsd::RobotActionOffer>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("actionType", &Acsd::RobotActionOffer::actionType),
        Required("description", &Acsd::RobotActionOffer::description),
        Required("parameters", &Acsd::RobotActionOffer::parameters));
};

template <>
struct JsonFields<Acsd::RobotActionsView>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("actions", &Acsd::RobotActionsView::actions),
        Required("offered", &Acsd::RobotActionsView::offered));
};

} // namespace ACS::Json

namespace ACS::Acsd
{

std::string EncodeActions(const RobotActionsView& view)
{
    std::string text;
    Json::JsonWriter writer(text);
    Json::Encode(view, writer);
    text += '\n';
    return text;
}

} // namespace ACS::Acsd
