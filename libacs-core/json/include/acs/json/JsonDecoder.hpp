#pragma once

#include <acs/core/JsonText.hpp>
#include <acs/core/Result.hpp>
#include <acs/json/DecodeContext.hpp>
#include <acs/json/EnumNames.hpp>
#include <acs/json/JsonDocument.hpp>
#include <acs/json/JsonFields.hpp>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

namespace ACS::Json
{

/// A value that is decoded later, when its kind is known (the payload behind a command). Valid while the document is.
struct DeferredValue
{
    const Value* valueOrNull = nullptr;
};

/// How a type is read from JSON; specialise for further leaf types.
template <typename T>
struct ValueDecoder;

template <typename T>
[[nodiscard]] bool TryDecode(const Value& value, T& out, const FieldBounds& bounds, DecodeContext& context)
{
    return ValueDecoder<T>::TryDecode(value, out, bounds, context);
}

[[nodiscard]] bool TryDecodeInteger(
    const Value& value,
    std::int64_t minimum,
    std::uint64_t maximum,
    std::int64_t& negativeOut,
    std::uint64_t& positiveOut,
    DecodeContext& context);
[[nodiscard]] bool TryDecodeNumber(const Value& value, double& out, const FieldBounds& bounds, DecodeContext& context);
[[nodiscard]] bool TryDecodeString(
    const Value& value,
    std::string_view& out,
    const FieldBounds& bounds,
    DecodeContext& context);
[[nodiscard]] bool TryCheckArray(const Value& value, const FieldBounds& bounds, DecodeContext& context);

template <>
struct ValueDecoder<bool>
{
    [[nodiscard]] static bool TryDecode(
        const Value& value,
        bool& bOut,
        const FieldBounds& bounds,
        DecodeContext& context);
};

template <>
struct ValueDecoder<double>
{
    [[nodiscard]] static bool TryDecode(
        const Value& value,
        double& out,
        const FieldBounds& bounds,
        DecodeContext& context)
    {
        return TryDecodeNumber(value, out, bounds, context);
    }
};

template <std::integral T>
    requires(!std::same_as<T, bool>)
struct ValueDecoder<T>
{
    [[nodiscard]] static bool TryDecode(const Value& value, T& out, const FieldBounds& bounds, DecodeContext& context)
    {
        constexpr T LOWEST = std::numeric_limits<T>::min();
        constexpr T HIGHEST = std::numeric_limits<T>::max();
        const std::int64_t minimum = bounds.minimum > static_cast<double>(LOWEST)
            ? static_cast<std::int64_t>(bounds.minimum)
            : static_cast<std::int64_t>(LOWEST);
        const std::uint64_t maximum = bounds.maximum < static_cast<double>(HIGHEST)
            ? static_cast<std::uint64_t>(bounds.maximum)
            : static_cast<std::uint64_t>(HIGHEST);
        std::int64_t negative = 0;
        std::uint64_t positive = 0;
        if (!TryDecodeInteger(value, minimum, maximum, negative, positive, context))
        {
            return false;
        }
        out = negative < 0 ? static_cast<T>(negative) : static_cast<T>(positive);
        return true;
    }
};

template <>
struct ValueDecoder<std::string>
{
    [[nodiscard]] static bool TryDecode(
        const Value& value,
        std::string& out,
        const FieldBounds& bounds,
        DecodeContext& context);
};

template <>
struct ValueDecoder<Core::JsonText>
{
    [[nodiscard]] static bool TryDecode(
        const Value& value,
        Core::JsonText& out,
        const FieldBounds& bounds,
        DecodeContext& context);
};

template <>
struct ValueDecoder<DeferredValue>
{
    [[nodiscard]] static bool TryDecode(
        const Value& value,
        DeferredValue& out,
        const FieldBounds& bounds,
        DecodeContext& context);
};

template <WordedEnum T>
struct ValueDecoder<T>
{
    [[nodiscard]] static bool TryDecode(const Value& value, T& out, const FieldBounds& bounds, DecodeContext& context)
    {
        std::string_view text;
        if (!TryDecodeString(value, text, bounds, context))
        {
            return false;
        }
        bool bExact = false;
        if (!TryReadWord(text, out, bExact) || (!bExact && !context.GetOptions().bWordsInAnyCase))
        {
            return context.IsFailedWith(Core::ECoreError::UnknownWord, ListWords<T>(), &value);
        }
        context.GetNotes().lenientWords += bExact ? 0U : 1U;
        return true;
    }
};

template <typename T>
struct ValueDecoder<std::optional<T>>
{
    [[nodiscard]] static bool TryDecode(
        const Value& value,
        std::optional<T>& out,
        const FieldBounds& bounds,
        DecodeContext& context)
    {
        if (value.IsNull())
        {
            out.reset();
            return true;
        }
        return ValueDecoder<T>::TryDecode(value, out.emplace(), bounds, context);
    }
};

template <typename T>
struct ValueDecoder<std::vector<T>>
{
    [[nodiscard]] static bool TryDecode(
        const Value& value,
        std::vector<T>& out,
        const FieldBounds& bounds,
        DecodeContext& context)
    {
        out.clear();
        if (!TryCheckArray(value, bounds, context))
        {
            return false;
        }
        FieldBounds elementBounds;
        elementBounds.minimum = bounds.minimum;
        elementBounds.maximum = bounds.maximum;
        elementBounds.minimumLength = bounds.minimumElement;
        elementBounds.maximumLength = bounds.maximumElement;
        elementBounds.bIdentifier = bounds.bIdentifier;
        out.reserve(value.Size());
        for (const Value& element : value.GetArray())
        {
            if (!ValueDecoder<T>::TryDecode(element, out.emplace_back(), elementBounds, context))
            {
                return context.IsFailedAt(out.size() - 1);
            }
        }
        return true;
    }
};

/// Decodes one member into its place in the struct; chosen by index, so that a message is read in one pass.
template <DescribedStruct T, std::size_t INDEX>
[[nodiscard]] bool TryDecodeField(const Value& value, T& object, DecodeContext& context)
{
    constexpr auto FIELD = std::get<INDEX>(EXPANDED_FIELDS<T>);
    auto&& member = FIELD.accessor(object);
    using Member = std::remove_cvref_t<decltype(member)>;
    if constexpr (FIELD.presence != EPresence::Required && FIELD.presence != EPresence::Alias)
    {
        if (value.IsNull() && !std::same_as<Member, Core::JsonText>)
        {
            constexpr bool B_NULLABLE = FIELD.presence == EPresence::Nullable;
            context.GetNotes().nullOptionals += B_NULLABLE ? 0U : 1U;
            if constexpr (B_NULLABLE && std::same_as<Member, double>)
            {
                member = std::numeric_limits<double>::quiet_NaN();
            }
            else
            {
                member = Member{};
            }
            return true;
        }
    }
    else if constexpr (std::same_as<Member, Core::JsonText>)
    {
        if (value.IsNull())
        {
            return context.IsFailedWith(Core::ECoreError::WrongType, "a value", &value)
                || context.IsFailedAt(FIELD.name);
        }
    }
    return ValueDecoder<Member>::TryDecode(value, member, FIELD.bounds, context) || context.IsFailedAt(FIELD.name);
}

template <DescribedStruct T>
struct FieldTable
{
    using DecodeFunction = bool (*)(const Value&, T&, DecodeContext&);

    static constexpr std::size_t COUNT = FIELD_COUNT<T>;
    static_assert(COUNT <= 64, "a message has at most 64 members");

    template <std::size_t... INDEX>
    [[nodiscard]] static constexpr std::array<DecodeFunction, COUNT> MakeFunctions(std::index_sequence<INDEX...>)
    {
        return {&TryDecodeField<T, INDEX>...};
    }

    template <std::size_t... INDEX>
    [[nodiscard]] static constexpr std::array<std::string_view, COUNT> MakeNames(std::index_sequence<INDEX...>)
    {
        return {std::get<INDEX>(EXPANDED_FIELDS<T>).name...};
    }

    template <std::size_t... INDEX>
    [[nodiscard]] static constexpr std::uint64_t MakeRequired(std::index_sequence<INDEX...>)
    {
        return (
            (std::get<INDEX>(EXPANDED_FIELDS<T>).presence == EPresence::Required ? std::uint64_t{1} << INDEX : 0U) | ...
            | std::uint64_t{0});
    }

    /// The field whose bit stands for each field: its own, or that of the field which an alias names again.
    template <std::size_t... INDEX>
    [[nodiscard]] static constexpr std::array<std::uint64_t, COUNT> MakeBits(std::index_sequence<INDEX...>)
    {
        const std::array<bool, COUNT> bAliases{(std::get<INDEX>(EXPANDED_FIELDS<T>).presence == EPresence::Alias)...};
        std::array<std::uint64_t, COUNT> bits{};
        for (std::size_t index = 0; index < COUNT; ++index)
        {
            bits[index] = bAliases[index] ? bits[index - 1] : std::uint64_t{1} << index;
        }
        return bits;
    }

    static constexpr std::array<std::uint64_t, COUNT> BITS = MakeBits(std::make_index_sequence<COUNT>{});
    static constexpr std::array<DecodeFunction, COUNT> FUNCTIONS = MakeFunctions(std::make_index_sequence<COUNT>{});
    static constexpr std::array<std::string_view, COUNT> NAMES = MakeNames(std::make_index_sequence<COUNT>{});
    static constexpr std::uint64_t REQUIRED = MakeRequired(std::make_index_sequence<COUNT>{});
};

/// Index of the field of this name, COUNT where there is none; checks the expected place first.
template <std::size_t COUNT>
[[nodiscard]] std::size_t FindField(
    const std::array<std::string_view, COUNT>& names,
    std::string_view name,
    std::size_t expected)
{
    if (expected < COUNT && names[expected] == name)
    {
        return expected;
    }
    for (std::size_t index = 0; index < COUNT; ++index)
    {
        if (names[index] == name)
        {
            return index;
        }
    }
    return COUNT;
}

[[nodiscard]] bool TryCheckRequired(
    std::uint64_t seen,
    std::uint64_t required,
    const std::string_view* namesOrNull,
    DecodeContext& context);

template <DescribedStruct T>
struct ValueDecoder<T>
{
    [[nodiscard]] static bool TryDecode(
        const Value& value,
        T& out,
        const FieldBounds& /*bounds*/,
        DecodeContext& context)
    {
        using Table = FieldTable<T>;
        if (!value.IsObject())
        {
            return context.IsFailedWith(Core::ECoreError::WrongType, "an object", &value);
        }
        std::uint64_t seen = 0;
        std::size_t expected = 0;
        const std::size_t firstUnknown = context.GetUnknownCount();
        for (const auto& member : value.GetObject())
        {
            const std::string_view name(member.name.GetString(), member.name.GetStringLength());
            const std::size_t index = FindField(Table::NAMES, name, expected);
            if (index == Table::COUNT)
            {
                if (!context.TryNoteUnknown(name, member.value, firstUnknown))
                {
                    return false;
                }
                continue;
            }
            const std::uint64_t bit = Table::BITS[index];
            if ((seen & bit) != 0)
            {
                return IsRepeatedMember(name, context);
            }
            seen |= bit;
            expected = index + 1;
            if (!Table::FUNCTIONS[index](member.value, out, context))
            {
                return false;
            }
        }
        return context.TryForgetUnknown(firstUnknown)
            && TryCheckRequired(seen, Table::REQUIRED, Table::NAMES.data(), context);
    }
};

} // namespace ACS::Json
