#include <acs/json/TaggedVariant.hpp>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace ACS::Json
{

bool TryDecodeTag(
    const Value& value,
    std::string_view name,
    std::span<const std::string_view> words,
    std::size_t& indexOut,
    DecodeContext& context)
{
    if (!value.IsObject())
    {
        return context.IsFailedWith(Core::ECoreError::WrongType, "an object", &value);
    }
    const Value* const tagOrNull = FindFirstOrNull(value, name);
    if (tagOrNull == nullptr)
    {
        return TryCheckRequired(0, 1, &name, context);
    }
    std::string_view word;
    if (!TryDecodeString(*tagOrNull, word, {}, context))
    {
        return context.IsFailedAt(name);
    }
    const auto found = std::ranges::find(words, word);
    if (found == words.end())
    {
        return context.IsFailedWith(
                   Core::ECoreError::UnknownWord,
                   fmt::format("one of {}", fmt::join(words, ", ")),
                   tagOrNull)
            || context.IsFailedAt(name);
    }
    indexOut = static_cast<std::size_t>(found - words.begin());
    return true;
}

} // namespace ACS::Json
