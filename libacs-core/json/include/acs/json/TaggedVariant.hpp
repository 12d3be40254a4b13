#pragma once

#include <acs/json/JsonDecoder.hpp>
#include <acs/json/JsonEncoder.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <string_view>
#include <tuple>
#include <utility>
#include <variant>

namespace ACS::Json
{

/// A variant of described structs as one JSON object, whose first member names the alternative. Specialise once per variant, with
/// a word for each alternative in their order:
/// `template <> struct VariantTag<Event> { static constexpr std::string_view NAME = "event";
/// static constexpr std::array<std::string_view, 2> WORDS{"Started", "Ended"}; };`
template <typename TVariant>
struct VariantTag;

template <typename TVariant>
concept TaggedVariant = requires
{
    VariantTag<TVariant>::NAME;
    requires VariantTag<TVariant>::WORDS.size() == std::variant_size_v<TVariant>;
};

/// An alternative with its tag, as it is read.
template <TaggedVariant TVariant, std::size_t INDEX>
struct TaggedAlternative
{
    DeferredValue tag;
    std::variant_alternative_t<INDEX, TVariant> content{};
};

template <TaggedVariant TVariant, std::size_t INDEX>
struct JsonFields<TaggedAlternative<TVariant, INDEX>>
{
    using Type = TaggedAlternative<TVariant, INDEX>;
    static constexpr auto FIELDS =
        std::make_tuple(Required(VariantTag<TVariant>::NAME, &Type::tag), Flat(&Type::content));
};

/// Reads which alternative the object has.
[[nodiscard]] bool TryDecodeTag(
    const Value& value,
    std::string_view name,
    std::span<const std::string_view> words,
    std::size_t& indexOut,
    DecodeContext& context);

/// The members of a variant, without the braces: for an object to which the caller adds members of its own.
template <TaggedVariant TVariant>
void EncodeMembers(const TVariant& value, JsonWriter& writer)
{
    writer.Key(VariantTag<TVariant>::NAME);
    writer.WritePlainString(VariantTag<TVariant>::WORDS[value.index()]);
    std::visit([&writer](const auto& content) { EncodeMembers(content, writer); }, value);
}

template <TaggedVariant TVariant>
struct ValueEncoder<TVariant>
{
    static void Encode(const TVariant& value, JsonWriter& writer)
    {
        writer.BeginObject();
        EncodeMembers(value, writer);
        writer.EndObject();
    }
};

template <TaggedVariant TVariant>
struct ValueDecoder<TVariant>
{
    using DecodeFunction = bool (*)(const Value&, TVariant&, DecodeContext&);

    template <std::size_t INDEX>
    [[nodiscard]] static bool TryDecodeAlternative(const Value& value, TVariant& out, DecodeContext& context)
    {
        TaggedAlternative<TVariant, INDEX> alternative;
        if (!Json::TryDecode(value, alternative, {}, context))
        {
            return false;
        }
        out.template emplace<INDEX>(std::move(alternative.content));
        return true;
    }

    template <std::size_t... INDEX>
    [[nodiscard]] static constexpr std::array<DecodeFunction, sizeof...(INDEX)> MakeFunctions(
        std::index_sequence<INDEX...> /*all*/)
    {
        return {&TryDecodeAlternative<INDEX>...};
    }

    [[nodiscard]] static bool TryDecode(
        const Value& value,
        TVariant& out,
        const FieldBounds& /*bounds*/,
        DecodeContext& context)
    {
        static constexpr auto FUNCTIONS = MakeFunctions(std::make_index_sequence<std::variant_size_v<TVariant>>{});
        std::size_t index = 0;
        return TryDecodeTag(value, VariantTag<TVariant>::NAME, VariantTag<TVariant>::WORDS, index, context)
            && FUNCTIONS[index](value, out, context);
    }
};

} // namespace ACS::Json
