#include "view/ActionCodec.hpp"

#include <acs/core/Timestamp.hpp>
#include <acs/json/JsonWriter.hpp>

namespace ACS::Acsd
{

namespace
{

void WriteAction(Json::JsonWriter& writer, const RobotActionRecord& record)
{
    writer.BeginObject();
    writer.Key("actionId");
    writer.WriteString(record.actionID);
    writer.Key("actionType");
    writer.WriteString(record.actionType);
    writer.Key("parameters");
    writer.BeginObject();
    for (const RobotActionParameter& parameter : record.parameters)
    {
        writer.Key(parameter.key);
        writer.WriteRaw(parameter.value);
    }
    writer.EndObject();
    writer.Key("reason");
    writer.WriteString(record.reason);
    writer.Key("requestedAt");
    writer.WritePlainString(Core::FormatUTC(record.requestedAt));
    writer.Key("status");
    writer.WritePlainString(GetText(record.status));
    writer.Key("resultDescription");
    writer.WriteString(record.resultDescription);
    writer.Key("endedAt");
    if (record.endedAt.has_value())
    {
        writer.WritePlainString(Core::FormatUTC(*record.endedAt));
    }
    else
    {
        writer.WriteNull();
    }
    writer.EndObject();
}

void WriteOffer(Json::JsonWriter& writer, const RobotActionOffer& offer)
{
    writer.BeginObject();
    writer.Key("actionType");
    writer.WriteString(offer.actionType);
    writer.Key("description");
    writer.WriteString(offer.description);
    writer.Key("parameters");
    writer.BeginArray();
    for (const RobotParameterOffer& parameter : offer.parameters)
    {
        writer.BeginObject();
        writer.Key("key");
        writer.WriteString(parameter.key);
        writer.Key("valueType");
        writer.WriteString(parameter.valueType);
        writer.Key("required");
        writer.WriteBoolean(parameter.bRequired);
        writer.EndObject();
    }
    writer.EndArray();
    writer.EndObject();
}

} // namespace

std::string EncodeActions(const RobotActionsView& view)
{
    std::string text;
    Json::JsonWriter writer(text);
    writer.BeginObject();
    writer.Key("actions");
    writer.BeginArray();
    for (const RobotActionRecord& record : view.actions)
    {
        WriteAction(writer, record);
    }
    writer.EndArray();
    writer.Key("offered");
    writer.BeginArray();
    for (const RobotActionOffer& offer : view.offered)
    {
        WriteOffer(writer, offer);
    }
    writer.EndArray();
    writer.EndObject();
    text += '\n';
    return text;
}

} // namespace ACS::Acsd
