#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <string_view>
#include <tuple>
#include <type_traits>
#include <utility>

namespace ACS::Json
{

/// How a member may be missing, and what is written when it has no value.
enum class EPresence : std::uint8_t
{
    Required,  ///< Must be there and not null; always written.
    Optional,  ///< May be absent (null is read as absent and counted); left out when nullopt, empty or not finite.
    Nullable,  ///< Of a std::optional: null or absent is nullopt; nullopt is written as null. Of a number: null if not
               ///< finite; absent leaves the default.
    Defaulted, ///< Absent or null leaves the struct's default; always written.
    Alias,     ///< Another name of the field in front of it: read as that field, never written, refused beside it.
};

/// One bit for each dialect of a protocol (its versions), given a meaning by the codec.
using DialectFlags = std::uint8_t;
inline constexpr DialectFlags ALL_DIALECTS = 0xFF;

/// Bounds of a number or of each number of an array, of a string's bytes, or of an array's elements and the bytes of each;
/// and whether that string, or each of those elements, names something.
struct FieldBounds
{
    double minimum = -std::numeric_limits<double>::infinity();
    double maximum = std::numeric_limits<double>::infinity();
    std::size_t minimumLength = 0;
    std::size_t maximumLength = std::numeric_limits<std::size_t>::max();
    std::size_t minimumElement = 0;
    std::size_t maximumElement = std::numeric_limits<std::size_t>::max();
    bool bIdentifier = false; ///< Without control characters.
};

/// The form that a strict reader takes: the range in which a number is written that Between tolerates, and the first
/// letter of the only kind of free value that is written.
struct WrittenForm
{
    static constexpr char ANY = '\0';
    static constexpr char OBJECT = '{';
    static constexpr char STRING = '"';

    double minimum = -std::numeric_limits<double>::infinity();
    double maximum = std::numeric_limits<double>::infinity();
    DialectFlags wholeIn = 0;
    char firstLetter = ANY;

    constexpr bool operator==(const WrittenForm&) const = default;
};

/// One member of a message: its JSON name, its struct member and its rules. This one description drives
/// decode, encode and checks.
template <typename TAccessor>
struct JsonField
{
    std::string_view name;
    TAccessor accessor;
    EPresence presence = EPresence::Required;
    FieldBounds bounds{};
    DialectFlags dialects = ALL_DIALECTS;
    WrittenForm written{};

    /// Written in these dialects only; read in all.
    [[nodiscard]] constexpr JsonField WrittenIn(DialectFlags flags) const
    {
        JsonField field = *this;
        field.dialects = flags;
        return field;
    }

    [[nodiscard]] constexpr JsonField Between(double minimum, double maximum) const
    {
        JsonField field = *this;
        field.bounds.minimum = minimum;
        field.bounds.maximum = maximum;
        return field;
    }

    /// What lies outside is written as the nearer bound: for the rounding errors that a lenient reader lets in.
    [[nodiscard]] constexpr JsonField WrittenBetween(double minimum, double maximum) const
    {
        JsonField field = *this;
        field.written.minimum = minimum;
        field.written.maximum = maximum;
        return field;
    }

    /// Written as a whole number in these dialects.
    [[nodiscard]] constexpr JsonField WholeIn(DialectFlags flags) const
    {
        JsonField field = *this;
        field.written.wholeIn = flags;
        return field;
    }

    /// Of an optional free value: left out where it is anything but an object.
    [[nodiscard]] constexpr JsonField WrittenIfObject() const
    {
        JsonField field = *this;
        field.written.firstLetter = WrittenForm::OBJECT;
        return field;
    }

    /// Of an optional free value: left out where it is anything but a string.
    [[nodiscard]] constexpr JsonField WrittenIfString() const
    {
        JsonField field = *this;
        field.written.firstLetter = WrittenForm::STRING;
        return field;
    }

    [[nodiscard]] constexpr JsonField WithLength(std::size_t minimum, std::size_t maximum) const
    {
        JsonField field = *this;
        field.bounds.minimumLength = minimum;
        field.bounds.maximumLength = maximum;
        return field;
    }

    /// Of an array of strings: the bytes of each.
    [[nodiscard]] constexpr JsonField WithElements(std::size_t minimum, std::size_t maximum) const
    {
        JsonField field = *this;
        field.bounds.minimumElement = minimum;
        field.bounds.maximumElement = maximum;
        return field;
    }

    /// Of a string or an array of strings: what is looked up, shown and logged, hence without control characters.
    [[nodiscard]] constexpr JsonField AsIdentifier() const
    {
        JsonField field = *this;
        field.bounds.bIdentifier = true;
        return field;
    }
};

template <typename TStruct, typename TMember>
struct MemberAccessor
{
    TMember TStruct::*member;

    constexpr TMember& operator()(TStruct& object) const
    {
        return object.*member;
    }

    constexpr const TMember& operator()(const TStruct& object) const
    {
        return object.*member;
    }
};

/// A member of a member: the field of a struct whose fields are flat in the same JSON object.
template <typename TOuter, typename TInner>
struct NestedAccessor
{
    TOuter outer;
    TInner inner;

    template <typename TStruct>
    constexpr decltype(auto) operator()(TStruct& object) const
    {
        return inner(outer(object));
    }
};

/// The description of a message struct; specialise once per struct, in the codec's .cpp or a header that all its users include:
/// `template <> struct JsonFields<Job> { static constexpr auto FIELDS = std::make_tuple(Required("jobId", &Job::jobID), …); };`
template <typename TStruct>
struct JsonFields;

template <typename TStruct>
concept DescribedStruct = requires
{
    JsonFields<TStruct>::FIELDS;
};

template <typename TStruct, typename TMember>
[[nodiscard]] constexpr auto Required(std::string_view name, TMember TStruct::*member)
{
    return JsonField<MemberAccessor<TStruct, TMember>>{name, {member}, EPresence::Required, {}, ALL_DIALECTS, {}};
}

template <typename TStruct, typename TMember>
[[nodiscard]] constexpr auto Optional(std::string_view name, TMember TStruct::*member)
{
    return JsonField<MemberAccessor<TStruct, TMember>>{name, {member}, EPresence::Optional, {}, ALL_DIALECTS, {}};
}

template <typename TStruct, typename TMember>
[[nodiscard]] constexpr auto Nullable(std::string_view name, TMember TStruct::*member)
{
    return JsonField<MemberAccessor<TStruct, TMember>>{name, {member}, EPresence::Nullable, {}, ALL_DIALECTS, {}};
}

template <typename TStruct, typename TMember>
[[nodiscard]] constexpr auto Defaulted(std::string_view name, TMember TStruct::*member)
{
    return JsonField<MemberAccessor<TStruct, TMember>>{name, {member}, EPresence::Defaulted, {}, ALL_DIALECTS, {}};
}

/// Directly follows its field, with the same member.
template <typename TStruct, typename TMember>
[[nodiscard]] constexpr auto Alias(std::string_view name, TMember TStruct::*member)
{
    return JsonField<MemberAccessor<TStruct, TMember>>{name, {member}, EPresence::Alias, {}, ALL_DIALECTS, {}};
}

/// A struct whose fields are flat in the JSON object of the enclosing struct (a message's header).
template <typename TStruct, typename TMember>
struct FlatField
{
    MemberAccessor<TStruct, TMember> accessor;
};

template <typename TStruct, typename TMember>
[[nodiscard]] constexpr auto Flat(TMember TStruct::*member)
{
    return FlatField<TStruct, TMember>{{member}};
}

template <typename TAccessor>
[[nodiscard]] constexpr auto ExpandField(const JsonField<TAccessor>& field)
{
    return std::make_tuple(field);
}

/// The fields of a struct with the flat ones expanded.
template <DescribedStruct TStruct>
[[nodiscard]] constexpr auto ExpandFields();

template <typename TStruct, typename TMember>
[[nodiscard]] constexpr auto ExpandField(const FlatField<TStruct, TMember>& flat)
{
    const auto nest = [&flat](const auto&... fields) {
        [[maybe_unused]] const auto wrap = [&flat](const auto& field) { // unused where there are no fields
            using Inner = std::remove_cvref_t<decltype(field.accessor)>;
            using Nested = NestedAccessor<MemberAccessor<TStruct, TMember>, Inner>;
            return JsonField<Nested>{
                field.name,
                Nested{flat.accessor, field.accessor},
                field.presence,
                field.bounds,
                field.dialects,
                field.written};
        };
        return std::make_tuple(wrap(fields)...);
    };
    return std::apply(nest, ExpandFields<TMember>());
}

template <DescribedStruct TStruct>
constexpr auto ExpandFields()
{
    const auto expand = [](const auto&... fields) {
        return std::tuple_cat(ExpandField(fields)...);
    };
    return std::apply(expand, JsonFields<TStruct>::FIELDS);
}

/// In the order in which they are written.
template <DescribedStruct TStruct>
inline constexpr auto EXPANDED_FIELDS = ExpandFields<TStruct>();

template <DescribedStruct TStruct>
inline constexpr std::size_t FIELD_COUNT = std::tuple_size_v<std::remove_cvref_t<decltype(EXPANDED_FIELDS<TStruct>)>>;

} // namespace ACS::Json
