#include "operator/CommandBodies.hpp"

#include <acs/json/JsonDecoder.hpp>
#include <acs/json/JsonDocument.hpp>
#include <acs/json/JsonFields.hpp>
#include <acs/plan/Block.hpp>

#include <cstddef>
#include <string>
#include <tuple>

namespace ACS::Json
{

/// Any object whose members have a value.
template <>
struct ValueDecoder<Acsd::ActionParametersBody>
{
    [[nodiscard]] static bool TryDecode(
        const Value& value,
        Acsd::ActionParametersBody& out,
        const FieldBounds& /*bounds*/,
        DecodeContext& context)
    {
        if (!value.IsObject())
        {
            return context.IsFailedWith(Core::ECoreError::WrongType, "an object", &value);
        }
        if (HasDuplicateNames(value))
        {
            return context.IsFailedWith(Core::ECoreError::InvalidJSON, "each member once", &value);
        }
        FieldBounds nameBounds;
        nameBounds.minimumLength = 1;
        nameBounds.maximumLength = Acsd::MOST_ACTION_NAME_BYTES;
        nameBounds.bIdentifier = true;
        std::size_t bytes = 0;
        out.values.clear();
        for (const auto& member : value.GetObject())
        {
            Acsd::RobotActionParameter& parameter = out.values.emplace_back();
            if (!Json::TryDecode(member.name, parameter.key, nameBounds, context)
                || !Json::TryDecode(member.value, parameter.value, FieldBounds(), context))
            {
                return false;
            }
            if (member.value.IsNull())
            {
                return context.IsFailedWith(Core::ECoreError::WrongType, "a value", &member.value);
            }
            bytes += parameter.key.size() + parameter.value.GetText().size();
        }
        if (bytes > Acsd::MOST_PARAMETER_BYTES)
        {
            return context.IsFailedWith(
                Core::ECoreError::TooLarge,
                "at most " + std::to_string(Acsd::MOST_PARAMETER_BYTES) + " bytes of keys and values",
                &value);
        }
        return true;
    }
};

template <>
struct JsonFields<Acsd::ActionBody>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("actionType", &Acsd::ActionBody::actionType)
            .WithLength(1, Acsd::MOST_ACTION_NAME_BYTES)
            .AsIdentifier(),
        Defaulted("parameters", &Acsd::ActionBody::parameters),
        Defaulted("reason", &Acsd::ActionBody::reason).WithLength(0, Acsd::MOST_REASON_BYTES).AsIdentifier());
};

template <>
struct JsonFields<Acsd::EmptyBody>
{
    static constexpr auto FIELDS = std::make_tuple();
};

template <>
struct JsonFields<Acsd::ReasonBody>
{
    static constexpr auto FIELDS = std::make_tuple(
        Defaulted("reason", &Acsd::ReasonBody::reason).WithLength(0, Acsd::MOST_REASON_BYTES).AsIdentifier());
};

template <>
struct JsonFields<Acsd::PriorityBody>
{
    static constexpr auto FIELDS = std::make_tuple(Required("priority", &Acsd::PriorityBody::priority));
};

template <>
struct JsonFields<Acsd::ResolveBody>
{
    static constexpr auto FIELDS = std::make_tuple(Required("outcome", &Acsd::ResolveBody::outcome));
};

template <>
struct JsonFields<Acsd::MaintenanceBody>
{
    static constexpr auto FIELDS = std::make_tuple(Required("on", &Acsd::MaintenanceBody::bOn));
};

template <>
struct JsonFields<Acsd::CarriersBody>
{
    static constexpr auto FIELDS = std::make_tuple(Required("carrierIds", &Acsd::CarriersBody::carrierIDs));
};

template <>
struct JsonFields<Acsd::ClearBody>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("robotId", &Acsd::ClearBody::robotID),
        Required("errorCode", &Acsd::ClearBody::errorCode),
        Optional("planId", &Acsd::ClearBody::planID),
        Optional("jobId", &Acsd::ClearBody::jobID));
};

template <>
struct JsonFields<Acsd::BlockBody>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("kind", &Acsd::BlockBody::kind),
        Required("id", &Acsd::BlockBody::placeID),
        Defaulted("reason", &Acsd::BlockBody::reason).WithLength(0, Planning::MAXIMUM_REASON_LENGTH).AsIdentifier());
};

template <>
struct JsonFields<Acsd::UnblockBody>
{
    static constexpr auto FIELDS =
        std::make_tuple(Required("kind", &Acsd::UnblockBody::kind), Required("id", &Acsd::UnblockBody::placeID));
};

} // namespace ACS::Json

namespace ACS::Acsd
{

template <typename TBody>
Core::Result<TBody> ReadBody(std::string_view text)
{
    Json::JsonDocument document;
    const Core::Result<const Json::Value*> root = document.Parse(text.empty() ? std::string_view("{}") : text, {});
    if (!root.has_value())
    {
        return tl::unexpected<Core::Error>(root.error());
    }
    Json::DecodeOptions options;
    options.bUnknownMembersRefused = true;
    Json::DecodeContext context(options);
    TBody body;
    if (!Json::TryDecode(**root, body, {}, context))
    {
        return tl::unexpected<Core::Error>(context.TakeError());
    }
    return body;
}

template Core::Result<EmptyBody> ReadBody<EmptyBody>(std::string_view text);
template Core::Result<ReasonBody> ReadBody<ReasonBody>(std::string_view text);
template Core::Result<PriorityBody> ReadBody<PriorityBody>(std::string_view text);
template Core::Result<ResolveBody> ReadBody<ResolveBody>(std::string_view text);
template Core::Result<MaintenanceBody> ReadBody<MaintenanceBody>(std::string_view text);
template Core::Result<CarriersBody> ReadBody<CarriersBody>(std::string_view text);
template Core::Result<ActionBody> ReadBody<ActionBody>(std::string_view text);
template Core::Result<ClearBody> ReadBody<ClearBody>(std::string_view text);
template Core::Result<BlockBody> ReadBody<BlockBody>(std::string_view text);
template Core::Result<UnblockBody> ReadBody<UnblockBody>(std::string_view text);

} // namespace ACS::Acsd
