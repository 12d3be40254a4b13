#pragma once

#include <acs/json/EnumWords.hpp>
#include <acs/json/JsonFields.hpp>
#include <acs/json/JsonWriter.hpp>

#include <concepts>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <vector>

namespace ACS::Json
{

/// How a type is written; specialise for further leaf types.
template <typename T>
struct ValueEncoder;

template <typename T>
void Encode(const T& value, JsonWriter& writer)
{
    ValueEncoder<T>::Encode(value, writer);
}

template <>
struct ValueEncoder<bool>
{
    static void Encode(bool bValue, JsonWriter& writer)
    {
        writer.WriteBoolean(bValue);
    }
};

template <>
struct ValueEncoder<double>
{
    static void Encode(double value, JsonWriter& writer)
    {
        writer.WriteNumber(value);
    }
};

template <std::integral T>
    requires(!std::same_as<T, bool>)
struct ValueEncoder<T>
{
    static void Encode(T value, JsonWriter& writer)
    {
        if constexpr (std::is_signed_v<T>)
        {
            writer.WriteInteger(value);
        }
        else
        {
            writer.WriteUnsigned(value);
        }
    }
};

template <>
struct ValueEncoder<std::string>
{
    static void Encode(const std::string& value, JsonWriter& writer)
    {
        writer.WriteString(value);
    }
};

template <>
struct ValueEncoder<Core::JsonText>
{
    static void Encode(const Core::JsonText& value, JsonWriter& writer)
    {
        writer.WriteRaw(value);
    }
};

template <WordedEnum T>
struct ValueEncoder<T>
{
    static void Encode(T value, JsonWriter& writer)
    {
        writer.WriteString(GetWord(value));
    }
};

template <typename T>
struct ValueEncoder<std::optional<T>>
{
    static void Encode(const std::optional<T>& value, JsonWriter& writer)
    {
        if (value.has_value())
        {
            ValueEncoder<T>::Encode(*value, writer);
        }
        else
        {
            writer.WriteNull();
        }
    }
};

template <typename T>
struct ValueEncoder<std::vector<T>>
{
    static void Encode(const std::vector<T>& values, JsonWriter& writer)
    {
        writer.BeginArray();
        for (const T& value : values)
        {
            ValueEncoder<T>::Encode(value, writer);
        }
        writer.EndArray();
    }
};

template <typename T>
[[nodiscard]] bool IsLeftOut(const T& member)
{
    if constexpr (requires { member.has_value(); })
    {
        return !member.has_value();
    }
    else if constexpr (requires { member.empty(); })
    {
        return member.empty();
    }
    else
    {
        return false;
    }
}

template <typename TField, typename TStruct>
void EncodeField(const TField& field, const TStruct& object, JsonWriter& writer)
{
    const auto& member = field.accessor(object);
    if (field.presence == EPresence::Alias || (field.dialects & writer.GetDialect()) == 0)
    {
        return;
    }
    if (field.presence == EPresence::Optional && IsLeftOut(member))
    {
        return;
    }
    writer.Key(field.name);
    ValueEncoder<std::remove_cvref_t<decltype(member)>>::Encode(member, writer);
}

/// The members of a described struct, without the braces: for an object to which the caller adds members of its own.
template <DescribedStruct T>
void EncodeMembers(const T& object, JsonWriter& writer)
{
    std::apply(
        [&object, &writer](const auto&... fields) { (EncodeField(fields, object, writer), ...); },
        EXPANDED_FIELDS<T>);
}

template <DescribedStruct T>
struct ValueEncoder<T>
{
    static void Encode(const T& object, JsonWriter& writer)
    {
        writer.BeginObject();
        EncodeMembers(object, writer);
        writer.EndObject();
    }
};

} // namespace ACS::Json
