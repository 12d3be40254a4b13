#pragma once

#include <acs/json/EnumNames.hpp>
#include <acs/json/JsonFields.hpp>
#include <acs/json/JsonWriter.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>
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
        writer.WritePlainString(GetWord(value));
    }
};

template <typename T>
struct ValueEncoder<std::optional<T>>
{
    static void Encode(const std::optional<T>& valueOrNull, JsonWriter& writer)
    {
        if (valueOrNull.has_value())
        {
            ValueEncoder<T>::Encode(*valueOrNull, writer);
        }
        else
        {
            writer.WriteNull();
        }
    }
};

template <typename T>
struct ValueEncoder<std::span<const T>>
{
    static void Encode(std::span<const T> values, JsonWriter& writer)
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
struct ValueEncoder<std::vector<T>>
{
    static void Encode(const std::vector<T>& values, JsonWriter& writer)
    {
        ValueEncoder<std::span<const T>>::Encode(values, writer);
    }
};

template <typename T>
[[nodiscard]] bool IsLeftOut(const T& member)
{
    if constexpr (std::same_as<T, std::optional<double>>)
    {
        return !std::isfinite(member.value_or(std::numeric_limits<double>::quiet_NaN()));
    }
    else if constexpr (requires { member.has_value(); })
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

/// `,"name":` of a field, made by the compiler: writing a key is then one copy.
template <DescribedStruct T, std::size_t INDEX>
struct KeyText
{
    static constexpr std::string_view NAME = std::get<INDEX>(EXPANDED_FIELDS<T>).name;
    static constexpr std::string_view FRONT = ",\"";
    static constexpr std::string_view BACK = "\":";
    static constexpr std::size_t LENGTH = FRONT.size() + NAME.size() + BACK.size();

    [[nodiscard]] static constexpr bool IsPlain()
    {
        return std::ranges::all_of(NAME, [](char letter) {
            return letter >= ' ' && letter <= '~' && letter != '"' && letter != '\\';
        });
    }
    static_assert(IsPlain(), "a member's name needs no escapes");

    [[nodiscard]] static constexpr std::array<char, LENGTH> MakeText()
    {
        std::array<char, LENGTH> text{};
        auto end = std::ranges::copy(FRONT, text.begin()).out;
        end = std::ranges::copy(NAME, end).out;
        std::ranges::copy(BACK, end);
        return text;
    }

    static constexpr std::array<char, LENGTH> TEXT = MakeText();
};

/// The number as a strict reader takes it. One that is not finite stays so, and is written as null.
[[nodiscard]] inline double Shape(double value, const WrittenForm& form, DialectFlags dialect)
{
    if (!std::isfinite(value))
    {
        return value;
    }
    const double bounded = std::clamp(value, form.minimum, form.maximum);
    return (form.wholeIn & dialect) != 0 ? std::round(bounded) : bounded;
}

[[nodiscard]] inline double Shape(
    const std::optional<double>& valueOrNull,
    const WrittenForm& form,
    DialectFlags dialect)
{
    return Shape(*valueOrNull, form, dialect);
}

template <DescribedStruct T, std::size_t INDEX>
void EncodeField(const T& object, JsonWriter& writer)
{
    constexpr auto FIELD = std::get<INDEX>(EXPANDED_FIELDS<T>);
    if constexpr (FIELD.presence != EPresence::Alias)
    {
        const auto& member = FIELD.accessor(object);
        if ((FIELD.dialects & writer.GetDialect()) == 0 || (FIELD.presence == EPresence::Optional && IsLeftOut(member)))
        {
            return;
        }
        constexpr bool B_FREE = FIELD.written.firstLetter != WrittenForm::ANY;
        if constexpr (B_FREE)
        {
            static_assert(FIELD.presence == EPresence::Optional, "only what may be missing is left out");
            if (!member->GetText().starts_with(FIELD.written.firstLetter))
            {
                return;
            }
        }
        using Key = KeyText<T, INDEX>;
        writer.WriteKeyText({Key::TEXT.data(), Key::LENGTH});
        if constexpr (
            FIELD.presence == EPresence::Nullable && std::same_as<std::remove_cvref_t<decltype(member)>, double>)
        {
            if (!std::isfinite(member))
            {
                writer.WriteNull();
                return;
            }
        }
        if constexpr (B_FREE || FIELD.written == WrittenForm{})
        {
            ValueEncoder<std::remove_cvref_t<decltype(member)>>::Encode(member, writer);
        }
        else
        {
            static_assert(FIELD.presence != EPresence::Nullable, "null has no form");
            writer.WriteNumber(Shape(member, FIELD.written, writer.GetDialect()));
        }
    }
}

template <DescribedStruct T, std::size_t... INDEX>
void EncodeFields(const T& object, JsonWriter& writer, std::index_sequence<INDEX...> /*all*/)
{
    (EncodeField<T, INDEX>(object, writer), ...);
}

/// The members of a described struct, without the braces: for an object to which the caller adds members of its own.
template <DescribedStruct T>
void EncodeMembers(const T& object, JsonWriter& writer)
{
    EncodeFields(object, writer, std::make_index_sequence<FIELD_COUNT<T>>{});
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
