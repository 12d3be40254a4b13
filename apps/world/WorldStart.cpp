#include "world/WorldStart.hpp"

#include "world/MemoryEnumNames.hpp"
#include <acs/json/JsonDocument.hpp>

#include <fmt/format.h>

#include <array>
#include <optional>
#include <set>
#include <utility>

namespace ACS::Sim
{
namespace
{

constexpr std::size_t MAX_BYTES = 64U * 1024U * 1024U;
constexpr std::size_t MAX_DEPTH = 4;
constexpr int VERSION = 1;

std::string_view GetView(const Json::Value& text)
{
    return {text.GetString(), text.GetStringLength()};
}

tl::unexpected<Core::Error> RefuseType(std::string path, std::string expected, const Json::Value& found)
{
    return Core::Fail(Core::ECoreError::WrongType, std::move(path), std::move(expected), Json::ShortenForError(found));
}

/// Reads an object whose members are strings. The reader gets each of them and returns whether it is valid.
template <typename TReader>
Core::Result<void> ReadWords(
    const Json::Value& object,
    std::string_view path,
    std::string_view expected,
    const TReader& tryRead)
{
    if (!object.IsObject())
    {
        return RefuseType(std::string(path), "an object", object);
    }
    for (const auto& member : object.GetObject())
    {
        const std::string name(GetView(member.name));
        if (!member.value.IsString() || !tryRead(name, GetView(member.value)))
        {
            return RefuseType(fmt::format("{}.{}", path, name), std::string(expected), member.value);
        }
    }
    return {};
}

Core::Result<void> ReadVersion(const Json::Value& value, WorldStart& /*start*/)
{
    if (!value.IsInt() || value.GetInt() != VERSION)
    {
        return RefuseType("version", fmt::format("{}", VERSION), value);
    }
    return {};
}

Core::Result<void> ReadCarriers(const Json::Value& value, WorldStart& start)
{
    return ReadWords(value, "carriers", "a place", [&start](const std::string& name, std::string_view place) {
        start.carriers.emplace(name, place);
        return true;
    });
}

Core::Result<void> ReadCovers(const Json::Value& value, WorldStart& start)
{
    constexpr std::string_view EXPECTED = R"("open" or "closed")";
    return ReadWords(value, "covers", EXPECTED, [&start](const std::string& name, std::string_view word) {
        start.covers.emplace(name, word == "closed");
        return word == "closed" || word == "open";
    });
}

Core::Result<void> ReadMemories(const Json::Value& value, WorldStart& start)
{
    return ReadWords(
        value,
        "memories",
        Json::ListWords<EMemory>(),
        [&start](const std::string& name, std::string_view word) {
            bool bExact = false;
            return Json::TryReadWord(word, start.memories[name], bExact) && bExact;
        });
}

Core::Result<void> ReadPlaces(const Json::Value& value, WorldStart& start)
{
    if (!value.IsArray())
    {
        return RefuseType("places", "an array", value);
    }
    for (const Json::Value& place : value.GetArray())
    {
        if (!place.IsString())
        {
            return RefuseType(
                fmt::format("places[{}]", &place - value.Begin()),
                "a place or a range of places (A01.CP01.TP01-04)",
                place);
        }
        start.places.emplace(GetView(place));
    }
    return {};
}

struct Member
{
    std::string_view name;
    Core::Result<void> (*read)(const Json::Value&, WorldStart&);
};

constexpr std::array MEMBERS{
    Member{"version", ReadVersion},
    Member{"carriers", ReadCarriers},
    Member{"covers", ReadCovers},
    Member{"memories", ReadMemories},
    Member{"places", ReadPlaces}};

/// The first duplicate name of the object.
std::optional<std::string> FindRepeatedOrNull(const Json::Value& object)
{
    std::set<std::string_view> names;
    for (const auto& member : object.GetObject())
    {
        if (!names.insert(GetView(member.name)).second)
        {
            return std::string(GetView(member.name));
        }
    }
    return std::nullopt;
}

/// Checks that no name is a duplicate, in the root and in its members.
Core::Result<void> CheckNames(const Json::Value& root)
{
    std::optional<std::string> repeated = FindRepeatedOrNull(root);
    for (auto member = root.MemberBegin(); !repeated.has_value() && member != root.MemberEnd(); ++member)
    {
        repeated = member->value.IsObject() ? FindRepeatedOrNull(member->value) : std::nullopt;
        if (repeated.has_value())
        {
            repeated = fmt::format("{}.{}", GetView(member->name), *repeated);
        }
    }
    if (repeated.has_value())
    {
        return Core::Fail(Core::ECoreError::InvalidJSON, *repeated, "each member once", "it twice");
    }
    return {};
}

Core::Result<void> ReadMember(std::string_view name, const Json::Value& value, WorldStart& start)
{
    for (const Member& member : MEMBERS)
    {
        if (member.name == name)
        {
            return member.read(value, start);
        }
    }
    return Core::Fail(
        Core::ECoreError::UnknownWord,
        Core::QuoteForError(name),
        "version, carriers, covers, memories or places");
}

} // namespace

Core::Result<WorldStart> DecodeWorldStart(std::string_view text)
{
    Json::JsonDocument document;
    const Core::Result<const Json::Value*> root = document.Parse(text, {MAX_BYTES, MAX_DEPTH});
    if (!root.has_value())
    {
        return tl::make_unexpected(root.error());
    }
    if (!(*root)->IsObject())
    {
        return RefuseType({}, "an object", **root);
    }
    const Core::Result<void> named = CheckNames(**root);
    if (!named.has_value())
    {
        return tl::make_unexpected(named.error());
    }
    if (Json::FindFirstOrNull(**root, "version") == nullptr)
    {
        return Core::Fail(Core::ECoreError::MissingField, "version", fmt::format("{}", VERSION), "nothing");
    }
    WorldStart start;
    for (const auto& member : (*root)->GetObject())
    {
        const Core::Result<void> read = ReadMember(GetView(member.name), member.value, start);
        if (!read.has_value())
        {
            return tl::make_unexpected(read.error());
        }
    }
    return start;
}

} // namespace ACS::Sim
