#pragma once

#include "../AngleBound.hpp"
#include "CodecBody.hpp"
#include <acs/core/Timestamp.hpp>
#include <acs/vda5050/Action.hpp>
#include <acs/vda5050/Header.hpp>
#include <acs/vda5050/OrderMessage.hpp>
#include <acs/vda5050/StateMessage.hpp>

#include <array>
#include <limits>
#include <numbers>
#include <string_view>
#include <tuple>

namespace ACS::VDA5050
{

/// Written is never more than pi itself.
inline constexpr double PI = std::numbers::pi;
inline constexpr double NO_MAXIMUM = std::numeric_limits<double>::infinity();

} // namespace ACS::VDA5050

namespace ACS::Json
{

template <>
struct ValueDecoder<Core::WallTime>
{
    [[nodiscard]] static bool TryDecode(
        const Value& value,
        Core::WallTime& out,
        const FieldBounds& bounds,
        DecodeContext& context)
    {
        std::string_view text;
        if (!TryDecodeString(value, text, bounds, context))
        {
            return false;
        }
        const Core::Result<Core::Timestamp> time = Core::ParseTimestamp(text);
        if (!time)
        {
            return context.IsFailedWith(time.error().code, time.error().expected, time.error().found);
        }
        out = time->time;
        return true;
    }
};

template <>
struct ValueEncoder<Core::WallTime>
{
    static void Encode(const Core::WallTime& value, JsonWriter& writer)
    {
        writer.WriteString(Core::FormatUTC(value));
    }
};

template <>
struct JsonFields<VDA5050::Header>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("headerId", &VDA5050::Header::headerID),
        Required("timestamp", &VDA5050::Header::timestamp),
        Required("version", &VDA5050::Header::version),
        Required("manufacturer", &VDA5050::Header::manufacturer),
        Required("serialNumber", &VDA5050::Header::serialNumber));
};

/// A member of the header of a message whose schema does not require it.
template <typename TMessage, typename TMember>
[[nodiscard]] constexpr auto DefaultedInHeader(std::string_view name, TMember VDA5050::Header::*member)
{
    using Outer = MemberAccessor<TMessage, VDA5050::Header>;
    using Inner = MemberAccessor<VDA5050::Header, TMember>;
    using Nested = NestedAccessor<Outer, Inner>;
    return JsonField<Nested>{name, Nested{{&TMessage::header}, {member}}, EPresence::Defaulted, {}, ALL_DIALECTS, {}};
}

template <>
struct EnumNames<VDA5050::EBlockingType>
{
    using Type = VDA5050::EBlockingType;
    static constexpr std::array WORDS{
        EnumWord<Type>{Type::None, "NONE"},
        EnumWord<Type>{Type::Soft, "SOFT"},
        EnumWord<Type>{Type::Hard, "HARD"}};
};

template <>
struct JsonFields<VDA5050::ActionParameter>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("key", &VDA5050::ActionParameter::key),
        Required("value", &VDA5050::ActionParameter::value));
};

template <>
struct JsonFields<VDA5050::Action>
{
    // actionName: an error in the instantActions schema of 2.0.0.
    static constexpr auto FIELDS = std::make_tuple(
        Required("actionType", &VDA5050::Action::actionType),
        Alias("actionName", &VDA5050::Action::actionType),
        Required("actionId", &VDA5050::Action::actionID),
        Optional("actionDescription", &VDA5050::Action::actionDescription),
        Required("blockingType", &VDA5050::Action::blockingType),
        Optional("actionParameters", &VDA5050::Action::actionParameters));
};

template <>
struct JsonFields<VDA5050::ControlPoint>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("x", &VDA5050::ControlPoint::x),
        Required("y", &VDA5050::ControlPoint::y),
        Optional("weight", &VDA5050::ControlPoint::weight).Between(0, VDA5050::NO_MAXIMUM));
};

template <>
struct JsonFields<VDA5050::Trajectory>
{
    static constexpr auto FIELDS = std::make_tuple(
        Defaulted("degree", &VDA5050::Trajectory::degree).Between(1, VDA5050::NO_MAXIMUM),
        Required("knotVector", &VDA5050::Trajectory::knotVector).Between(0, 1),
        Required("controlPoints", &VDA5050::Trajectory::controlPoints));
};

template <>
struct JsonFields<VDA5050::BoundingBoxReference>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("x", &VDA5050::BoundingBoxReference::x),
        Required("y", &VDA5050::BoundingBoxReference::y),
        Required("z", &VDA5050::BoundingBoxReference::z),
        Optional("theta", &VDA5050::BoundingBoxReference::theta));
};

template <>
struct JsonFields<VDA5050::LoadDimensions>
{
    static constexpr auto FIELDS = std::make_tuple(
        Required("length", &VDA5050::LoadDimensions::length),
        Required("width", &VDA5050::LoadDimensions::width),
        Optional("height", &VDA5050::LoadDimensions::height));
};

} // namespace ACS::Json
