#pragma once

#include <acs/json/JsonDecoder.hpp>
#include <acs/json/JsonEncoder.hpp>

#include <cstdint>
#include <optional>
#include <string_view>

namespace ACS::Json
{

// A std::chrono time or duration, or an optional one, as its count of ticks, so that nothing of it is lost: for stores and
// recordings, not for messages. A way to write a field, not a type, because each protocol has its own text for the same type.

[[nodiscard]] constexpr std::int64_t GetTicks(const auto& time)
{
    if constexpr (requires { time.time_since_epoch(); })
    {
        return time.time_since_epoch().count();
    }
    else
    {
        return time.count();
    }
}

template <typename TTime>
constexpr void SetTicks(TTime& time, std::int64_t ticks)
{
    if constexpr (requires { typename TTime::clock; })
    {
        time = TTime(typename TTime::duration(ticks));
    }
    else
    {
        time = TTime(ticks);
    }
}

template <typename TTime>
constexpr void SetTicks(std::optional<TTime>& timeOrNull, std::int64_t ticks)
{
    SetTicks(timeOrNull.emplace(), ticks);
}

/// Refers to a time of a struct for the length of an expression.
template <typename TTime>
struct TickCount
{
    TTime* time = nullptr;
};

template <typename TTime>
[[nodiscard]] bool IsLeftOut(const TickCount<TTime>& ticks)
{
    if constexpr (requires { ticks.time->has_value(); })
    {
        return !ticks.time->has_value();
    }
    return false;
}

template <typename TStruct, typename TTime>
struct TickAccessor
{
    TTime TStruct::*member;

    constexpr TickCount<TTime> operator()(TStruct& object) const
    {
        return {&(object.*member)};
    }

    constexpr TickCount<const TTime> operator()(const TStruct& object) const
    {
        return {&(object.*member)};
    }
};

template <typename TTime>
struct ValueEncoder<TickCount<TTime>>
{
    static void Encode(const TickCount<TTime>& ticks, JsonWriter& writer)
    {
        if constexpr (requires { ticks.time->has_value(); })
        {
            writer.WriteInteger(GetTicks(**ticks.time));
        }
        else
        {
            writer.WriteInteger(GetTicks(*ticks.time));
        }
    }
};

template <typename TTime>
struct ValueDecoder<TickCount<TTime>>
{
    [[nodiscard]] static bool TryDecode(
        const Value& value,
        TickCount<TTime>& out,
        const FieldBounds& bounds,
        DecodeContext& context)
    {
        std::int64_t ticks = 0;
        if (!ValueDecoder<std::int64_t>::TryDecode(value, ticks, bounds, context))
        {
            return false;
        }
        SetTicks(*out.time, ticks);
        return true;
    }
};

template <typename TStruct, typename TTime>
[[nodiscard]] constexpr auto RequiredTicks(std::string_view name, TTime TStruct::*member)
{
    static_assert(
        !requires(TTime value) { value.has_value(); },
        "what is required has a value");
    return JsonField<TickAccessor<TStruct, TTime>>{name, {member}, EPresence::Required};
}

/// Null leaves the struct's default.
template <typename TStruct, typename TTime>
[[nodiscard]] constexpr auto OptionalTicks(std::string_view name, TTime TStruct::*member)
{
    return JsonField<TickAccessor<TStruct, TTime>>{name, {member}, EPresence::Optional};
}

} // namespace ACS::Json
